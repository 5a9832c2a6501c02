// Refuses scenes with springs, for engines that have no springs and would give wrong results.
#pragma once

#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::core {

inline Status refuse_springs(const Scene& scene) {
  if (scene.springs.empty()) return Done{};
  return Error{"the scene has springs, which this engine does not simulate", scene.name, "use octree-cpu or hash-cpu"};
}

}  // namespace broadside::core

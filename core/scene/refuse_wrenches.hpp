// Refuses scenes with wrenches, for engines that apply no wrenches and would give wrong results.
#pragma once

#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::core {

inline Status refuse_wrenches(const Scene& scene) {
  if (scene.wrenches.empty()) return Done{};
  return Error{"unsupported: wrench, a force or torque on a body, which this engine does not apply", scene.name,
               "use plain-rigid, or leave out the scene's wrenches", Exit::kMissing};
}

}  // namespace broadside::core

// Refuses scenes whose bodies turn, for engines whose bodies only translate and that would give wrong results.
#pragma once

#include <string>

#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::core {

inline Status refuse_turning(const Scene& scene) {
  if (scene.motion == Motion::kRigid)
    return Error{"the scene's bodies turn, and this engine's bodies translate only", scene.name,
                 "use an engine that declares motion = rigid", Exit::kMissing};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    if (!(scene.bodies[i].angular_velocity == Vec3{}))
      return Error{"angular_velocity is not zero, and this pipeline's bodies translate only",
                   scene.name + ": body " + std::to_string(i), "set angular_velocity to 0 0 0"};
  return Done{};
}

}  // namespace broadside::core

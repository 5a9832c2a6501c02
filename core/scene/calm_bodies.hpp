// Whether a step of a scene whose masses are far apart may be taken at once (UnevenStep): nothing moves fast.
#pragma once

#include <cstddef>
#include <span>

#include "core/math/vec3.hpp"
#include "core/method/rigid/sleep.hpp"
#include "core/scene/rigid_bodies.hpp"

namespace broadside::core {

// No point of a body moves faster than gravity makes it in two steps. states: by body, as the step begins. What is fast
// need not be near such bodies: who is struck strikes others within the same step.
inline bool are_calm(const RigidBodies& bodies, std::span<const RigidState> states, Vec3 gravity_m_s2, float dt_s) {
  const float slow_m_s = 2.0F * dt_s * length(gravity_m_s2);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!(bodies.mass[i].inverse_mass > 0.0F)) continue;
    const float outer_m = bodies.shapes[bodies.shape[i]].balls.outer_m;
    if (!(fastest_of_body_m_s(states[i], bodies.mass[i], outer_m) <= slow_m_s)) return false;
  }
  return true;
}

}  // namespace broadside::core

// Whether nothing moves fast as a step begins: then a step of few contacts is solved farther (SoftSettings), and one of
// masses that are far apart is taken at once.
#pragma once

#include <cstddef>
#include <span>

#include "core/math/vec3.hpp"
#include "core/method/rigid/sleep.hpp"
#include "core/scene/rigid_bodies.hpp"

namespace broadside::core {

// No point of a body moves faster than gravity makes it in two steps.
inline float calm_speed_m_s(Vec3 gravity_m_s2, float dt_s) {
  return 2.0F * dt_s * length(gravity_m_s2);
}

// states: by body. What is fast need not be near such bodies: who is struck strikes others within the same step.
inline bool are_calm(const RigidBodies& bodies, std::span<const RigidState> states, Vec3 gravity_m_s2, float dt_s) {
  const float slow_m_s = calm_speed_m_s(gravity_m_s2, dt_s);
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!(bodies.mass[i].inverse_mass > 0.0F)) continue;
    const float outer_m = bodies.shapes[bodies.shape[i]].balls.outer_m;
    if (!(fastest_of_body_m_s(states[i], bodies.mass[i], outer_m) <= slow_m_s)) return false;
  }
  return true;
}

}  // namespace broadside::core

// When a body that stands still stops being solved: RIGID 8.8.
//
// A body is still while no point of it moves faster than a sixteenth of what gravity gives in a step: nothing that
// falls is as slow for two steps. An island, bodies that touch each other directly or through others, sleeps when each
// of its bodies has been still long enough, and wakes as one when something that is awake comes to touch it. Asleep a
// body has no velocity, and its contacts give it, step by step, what they gave it in its last step awake.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/rigid_integrate.hpp"
#include "core/method/rigid/rigid_state.hpp"

namespace broadside::core {

// 0 without gravity: there nothing says how slow is slow, and nobody sleeps.
BROADSIDE_HD float sleep_speed_m_s(Vec3 gravity_m_s2, float dt_s) {
  constexpr float kShare = 1.0F / 16.0F;
  return kShare * length(gravity_m_s2) * dt_s;
}

// No point of a body that reaches outer_m from its center of mass moves faster.
BROADSIDE_HD float fastest_of_body_m_s(const RigidState& s, const RigidMass& mass, float outer_m) {
  return length(s.v) + length(angular_velocity(mass, s)) * outer_m;
}

// Steps for which a body is still before it sleeps: a second of a body of a meter, for others as long as they take to
// fall a fixed number of their sizes, since a body that stands on its edge takes the longer to tip the larger it is.
// At least so many that an impulse has gone through a pile.
BROADSIDE_HD std::uint32_t still_steps_to_sleep(float outer_m, Vec3 gravity_m_s2, float dt_s) {
  constexpr float kLeastSteps = 32.0F;
  constexpr float kMostSteps = 65536.0F;
  constexpr float kFalls = 2.0F;
  const float steps = kFalls * sqrtf(2.0F * outer_m / length(gravity_m_s2)) / dt_s;
  return static_cast<std::uint32_t>(fminf(fmaxf(steps, kLeastSteps), kMostSteps));
}

// For how many steps in a row the body has been still, this one included.
BROADSIDE_HD std::uint32_t still_steps(std::uint32_t before, const RigidState& s, const RigidMass& mass, float outer_m,
                                       float sleep_speed_m_s) {
  return fastest_of_body_m_s(s, mass, outer_m) < sleep_speed_m_s ? before + 1 : 0;
}

BROADSIDE_HD constexpr RigidState stopped(RigidState s) {
  s.v = {};
  s.angular_momentum = {};
  return s;
}

}  // namespace broadside::core

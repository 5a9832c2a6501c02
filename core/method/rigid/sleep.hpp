// When a body at rest is no longer solved: RIGID 8.8.
//
// A body is still while no point of it moves faster than a sixteenth of the speed that gravity gives in a step; a
// falling body is not so slow for two steps. An island is a set of bodies that touch each other directly or through
// others. It sleeps when each of its bodies has been still long enough, and wakes as a whole when an awake body touches
// it. While it sleeps, a body has no velocity, and its contacts give it in every step the impulses of its last step
// awake.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/rigid_integrate.hpp"
#include "core/method/rigid/rigid_state.hpp"

namespace broadside::core {

// 0 without gravity: then nothing says how slow is slow, and bodies never sleep.
BROADSIDE_HD float sleep_speed_m_s(Vec3 gravity_m_s2, float dt_s) {
  constexpr float kShare = 1.0F / 16.0F;
  return kShare * length(gravity_m_s2) * dt_s;
}

// A bound of the speed of all points of a body that reaches outer_m from its center of mass.
BROADSIDE_HD float fastest_of_body_m_s(const RigidState& s, const RigidMass& mass, float outer_m) {
  return length(s.v) + length(angular_velocity(mass, s)) * outer_m;
}

// How many steps a body is still before it sleeps. It is the time of a fixed number of falls of the body's own size, a
// second for a body of a meter, because the larger a body is the longer it takes to tip when it stands on its edge. It
// is at least the number of steps that an impulse takes through a pile.
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

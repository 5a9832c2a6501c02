// What laws about impulses must allow for a body that sleeps.
#pragma once

#include "validation/mechanics/motion.hpp"

namespace broadside::validation {

// A body that an engine stopped and holds, as it declared, has no velocity, bit for bit. Its recorded impulses may be
// those of its last step awake, in which its speed changed from one below the declared speed to another. They change
// the speed of its points by at most this, m/s. 0 for a body that moves, or that was stopped from a higher speed.
inline double slack_of_sleep_m_s(const BodyStep& b, const BodyFacts& f, double sleep_speed_m_s) {
  const auto is_zero = [](Vec3d v) { return v.x == 0.0 && v.y == 0.0 && v.z == 0.0; };
  if (!is_zero(b.after.v) || !is_zero(b.after.w)) return 0.0;
  const bool was_slow = length(b.before.v) + length(b.before.w) * f.reach_m <= sleep_speed_m_s;
  return was_slow ? 2.0 * sleep_speed_m_s : 0.0;
}

}  // namespace broadside::validation

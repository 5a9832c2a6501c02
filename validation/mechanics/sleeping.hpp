// What laws of impulses leave open for a body that sleeps.
#pragma once

#include "validation/mechanics/motion.hpp"

namespace broadside::validation {

// A body that an engine stopped and holds, as it declared, has no velocity, bit for bit. Its impulses may be those of
// its last step awake, in which it went from one speed below the declared one to another: no point of it moves by more
// than this for them, m/s. 0 of a body that moves, or that was stopped from a higher speed.
inline double slack_of_sleep_m_s(const BodyStep& b, const BodyFacts& f, double sleep_speed_m_s) {
  const auto is_zero = [](Vec3d v) { return v.x == 0.0 && v.y == 0.0 && v.z == 0.0; };
  if (!is_zero(b.after.v) || !is_zero(b.after.w)) return 0.0;
  const bool was_slow = length(b.before.v) + length(b.before.w) * f.reach_m <= sleep_speed_m_s;
  return was_slow ? 2.0 * sleep_speed_m_s : 0.0;
}

}  // namespace broadside::validation

// The numbers that a substep of core/method/rigid/soft_contact.hpp is solved with.
#pragma once

#include <cstdint>
#include <limits>

#include "core/attributes.hpp"

namespace broadside::core {

// Numbers of one substep, the same for all contacts.
struct SoftStep {
  float dt_s = 0.0F;  // of the substep
  float per_dt_s = 0.0F;
  // The rate at which a gap's difference from the slop is taken away, per second; and the shares of mass and impulse
  // that make the contact soft.
  float push_rate_per_s = 0.0F;
  float mass_scale = 1.0F;
  float impulse_scale = 0.0F;
  float yield_scale = 0.0F;  // the second over the first
  // The speed at which a point above the slop sinks into it: a small share of the speed that gravity gives, so that the
  // point bears its load, and friction holds, from the first substep on.
  float settle_m_s = 0.0F;
  float least_done_m_s = 0.0F;   // changes of speed below this do not keep sweeps going
  float bounce_from_m_s = 0.0F;  // approach speeds above this bounce
  // Pushes that are faster than this are taken back (pushed_apart.hpp).
  float kept_push_m_s = std::numeric_limits<float>::max();
  float least_relax_m_s = 0.0F;  // changes of speed below this end the sweeps that relax what was taken back
  // Patches that relaxation changes by more than the first of these are swept with those that bounce; if it changes one
  // by more than the second, they are swept even if nothing bounces.
  float stirring_m_s = std::numeric_limits<float>::max();
  float begins_m_s = std::numeric_limits<float>::max();
  float gravity_m_s2 = 0.0F;
  // The last sweep is the first that changes no point's speed by more than this share of the fastest speed, or else
  // number most_sweeps.
  float done_share = 0.0F;
  std::uint32_t most_sweeps = 1;
  std::uint32_t most_relax_sweeps = 0;  // sweeps that relax after pushes were taken back
  // While something bounces: the most sweeps that stop points that approached fast, and that let them bounce.
  std::uint32_t most_stop_sweeps = 0;
  std::uint32_t most_bounce_sweeps = 0;
};

// A spring and damper under each contact, taken implicitly: frequency and damping in units of the substep, omega h and
// zeta. At rest it yields by (impulse / mass) / (h omega^2).
BROADSIDE_HD SoftStep soft_step(float dt_s, float omega_dt, float damping) {
  SoftStep s;
  s.dt_s = dt_s;
  s.per_dt_s = 1.0F / dt_s;
  const float a1 = 2.0F * damping + omega_dt;
  const float a2 = omega_dt * a1;
  const float a3 = 1.0F / (1.0F + a2);
  s.push_rate_per_s = omega_dt * s.per_dt_s / a1;
  s.mass_scale = a2 * a3;
  s.impulse_scale = a3;
  s.yield_scale = 1.0F / a2;
  return s;
}

// Sweeps end with one that changes no point's speed by more than this, m/s. fastest_m_s: the fastest speed of all
// points.
BROADSIDE_HD constexpr float done_m_s(const SoftStep& step, float done_share, float fastest_m_s) {
  const float of_fastest = done_share * fastest_m_s;
  return of_fastest > step.least_done_m_s ? of_fastest : step.least_done_m_s;
}

// To be called before the relaxation of a substep with several sweeps. done_m_s: the change of speed below which these
// sweeps ended. is_pushed: whether pushes are taken back; then the patches that this changes are swept anyway. Without
// gravity nothing says which pushes are small, so patches that relaxation changes by more than done_m_s are swept
// again. Relaxation alone solves a point that is first met because its body turned, and one sweep of it gives the two
// ends of an edge unequal impulses: a needle that struck a plate with its edge went on with 390 rad/s about its own
// axis.
BROADSIDE_HD constexpr void sweep_on_from(SoftStep& step, float done_m_s, bool is_pushed) {
  if (step.gravity_m_s2 > 0.0F) return;
  step.stirring_m_s = step.begins_m_s = is_pushed ? std::numeric_limits<float>::max() : done_m_s;
}

// Whether sweeps may begin because of pushes alone.
BROADSIDE_HD constexpr bool may_begin(const SoftStep& step) {
  return step.begins_m_s < std::numeric_limits<float>::max();
}

}  // namespace broadside::core

// What the soft solver may be set to, and the numbers of a step that follow.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/pushed_apart.hpp"
#include "core/method/rigid/soft_contact.hpp"

namespace broadside::core {

// What of a patch is small, or fast.
struct PatchLimits {
  float slop_share = 0.0F;    // of the patch's reach
  float fixed_slop_m = 0.0F;  // in its place, where it is given
};

// Where masses are further apart than SoftSettings::even_masses. A contact of a light body bears what a heavy one needs
// to stop: as stiff as the light one alone allows, 8 kg at 9 m/s sank into 16 g by a quarter of its side, and sweeps
// that stop early leave as much.
struct UnevenSettings {
  // A step of a scene with such masses is taken in so many equal parts, each of which detects anew: light bodies that
  // are struck turn by half a radian within a step, and meet in points that its start does not show.
  std::uint32_t parts = 4;
  // Of a step or its part in which such bodies touch: so many times the substeps, and what its sweeps are.
  std::uint32_t factor = 1;
  std::uint32_t sweeps = 1000;
  // Of what is at rest: there sweeps may go on and on, friction makes them change little and never less.
  std::uint32_t calm_sweeps = 500;
  float done = 1e-4F;
  float done_of_gravity = 0x1p-5F;
  float omega_dt = 200.0F;
};

// core/method/rigid/SOLVERS.md has the measurements that the defaults were chosen by.
struct SoftSettings {
  std::uint32_t substeps = 4;  // of a step, or of its part
  float even_masses = 64.0F;
  UnevenSettings uneven;
  // Of a substep, at most. One sweep is Catto's soft step; more go along conjugate directions.
  std::uint32_t sweeps = 12;
  // A sweep is the last one that changes no point's speed by more than this share of the fastest, or by more than this
  // share of what gravity gives in a substep: where all rests, the fastest is no faster than that, and one point of a
  // thousand kept everybody sweeping.
  float done = 0x1p-10F;
  float done_of_gravity = 0x1p-5F;
  float omega_dt = 6.0F;
  float damping = 1.0F;
  PatchLimits limits{0x1p-16F, 0.0F};
  float fixed_bounce_from_m_s = 0.0F;  // 0 = twice what gravity gives in a step
};

// Catto's soft step, without conjugate directions. Its cost is known ahead, so what it pushes apart is relaxed once and
// not taken back (pushed_apart.hpp): one sweep leaves heaps a little deep in every substep, and on an H100 sweeping
// until little changes made a step of 1,000 resting cubes fifteen times as long.
inline SoftSettings soft_step_settings() {
  SoftSettings settings;
  settings.substeps = 8;
  settings.sweeps = 1;
  settings.omega_dt = 1.2F;
  settings.uneven = {1, 4, 1, 1, settings.done, settings.done_of_gravity, settings.omega_dt};
  return settings;
}

// Stiffer contacts that are solved farther, for what stands by little: contacts of an arch of 25 stones yield by more
// than the 1 % by which it stands.
inline SoftSettings stiff_settings() {
  SoftSettings settings;
  settings.substeps = 8;
  settings.sweeps = 100;
  settings.done = 1e-5F;
  settings.done_of_gravity = 0x1p-10F;
  settings.omega_dt = 20.0F;
  return settings;
}

// What a step does at most: its substeps, and how often a substep adds to the velocities of a contact's bodies.
struct MostOfStep {
  std::uint32_t substeps = 0;
  std::uint32_t applications = 0;
};

BROADSIDE_HD constexpr std::uint32_t substeps_of(const SoftSettings& settings, bool is_uneven) {
  return is_uneven ? settings.uneven.factor * settings.substeps : settings.substeps;
}

// A solver whose cost is known ahead keeps what pushes.
constexpr bool takes_back_pushes(const SoftSettings& settings) {
  return settings.sweeps > 1;
}

// In how many parts a step is taken of bodies whose masses are so many times apart.
constexpr std::uint32_t parts_of_step(const SoftSettings& settings, float largest_mass_ratio) {
  return largest_mass_ratio > settings.even_masses ? settings.uneven.parts : 1;
}

inline MostOfStep most_of_step(const SoftSettings& settings, float largest_mass_ratio, bool may_bounce) {
  const bool is_uneven = largest_mass_ratio > settings.even_masses;
  const std::uint32_t sweeps = is_uneven ? settings.uneven.sweeps : settings.sweeps;
  // The start from the last impulse, sweeps with a step along the direction between two, and relaxation.
  std::uint32_t applications = 1 + (2 * sweeps - 1) + 1;
  // What pushes apart is taken back: a start without it, and what changes by that relaxes.
  if (takes_back_pushes(settings)) applications += 1 + kMostRelaxSweeps;
  // Before a bounce all relaxes; a sweep of it visits a patch's points several times, and its friction.
  if (may_bounce) applications += kMostBounceSweeps + kMostBounceSweeps * (kSweepsOfBounce + 1);
  return {parts_of_step(settings, largest_mass_ratio) * substeps_of(settings, is_uneven), applications};
}

// dt_s: of the step, or of its part.
inline SoftStep soft_step_of(const SoftSettings& settings, Vec3 gravity_m_s2, float dt_s, bool is_uneven) {
  constexpr float kSettleShare = 0.05F;
  // A push that stays as speed leaves a sixteenth of what explicit and implicit Euler differ by in a step.
  constexpr float kKeptPushShare = 0.25F;
  const float gravity = length(gravity_m_s2);
  const UnevenSettings& uneven = settings.uneven;
  SoftStep step = soft_step(dt_s / static_cast<float>(substeps_of(settings, is_uneven)),
                            is_uneven ? uneven.omega_dt : settings.omega_dt, settings.damping);
  step.most_sweeps = is_uneven ? uneven.sweeps : settings.sweeps;
  step.calm_sweeps = is_uneven ? uneven.calm_sweeps : settings.sweeps;
  step.done_share = is_uneven ? uneven.done : settings.done;
  step.gravity_m_s2 = gravity;
  step.least_done_m_s = (is_uneven ? uneven.done_of_gravity : settings.done_of_gravity) * gravity * step.dt_s;
  step.settle_m_s = kSettleShare * gravity * step.dt_s;
  step.bounce_from_m_s = settings.fixed_bounce_from_m_s > 0.0F ? settings.fixed_bounce_from_m_s : 2.0F * dt_s * gravity;
  step.calm_m_s = 2.0F * dt_s * gravity;
  step.kept_push_m_s =
      takes_back_pushes(settings) ? kKeptPushShare * gravity * dt_s : std::numeric_limits<float>::max();
  return step;
}

// The larger of two masses that move over the smaller; 1 where one of them does not.
BROADSIDE_HD constexpr float mass_ratio(float inverse_mass_a, float inverse_mass_b) {
  if (!(inverse_mass_a > 0.0F) || !(inverse_mass_b > 0.0F)) return 1.0F;
  return inverse_mass_a > inverse_mass_b ? inverse_mass_a / inverse_mass_b : inverse_mass_b / inverse_mass_a;
}

// dt_s: of the step.
BROADSIDE_HD void set_limits(PatchConstraint& c, const SolverBody& a, const SolverBody& b, const PatchLimits& limits,
                             float dt_s) {
  // Without gravity nothing says how fast is fast but the step.
  constexpr float kPushShare = 1.0F / 64.0F;
  const float reach = reach_of(c, a, b);
  c.slop_m = limits.fixed_slop_m > 0.0F ? limits.fixed_slop_m : limits.slop_share * reach;
  c.fastest_push_m_s = kPushShare * reach / dt_s;
}

}  // namespace broadside::core

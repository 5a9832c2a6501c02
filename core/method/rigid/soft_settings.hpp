// What the soft solver may be set to, and the numbers of a step that follow.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

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

// What contacts are solved with in a step, or a part of one.
struct SolveNumbers {
  std::uint32_t substeps = 1;
  // Of a substep, at most. One sweep is Catto's soft step; more go along conjugate directions.
  std::uint32_t sweeps = 1;
  // A sweep is the last one that changes no point's speed by more than this share of the fastest, or by more than this
  // share of what gravity gives in a substep.
  float done = 0.0F;
  float done_of_gravity = 0.0F;
  float omega_dt = 0.0F;  // soft_step of soft_contact.hpp
  // Of a substep in which something bounces, at most: sweeps that stop what came fast. A heap that lands would take
  // hundreds.
  std::uint32_t stop_sweeps = 16;
  // Of a substep whose pushes are taken back, at most: sweeps that find what is left then.
  std::uint32_t relax_sweeps = 48;
  // Such a sweep is the last one that changes no point's speed by more than this share of a small push.
  float relax_done_of_small = 0.0F;
  // Where pushes are kept: patches that relaxation changes by more than this share of a small push are swept with those
  // that bounce, until they change by less; 0: none are.
  float stirred_of_small = 0.0F;
  // And they are swept without anything that bounces, where relaxation changes one by more than this share; 0: never.
  float begins_of_small = 0.0F;
};

// In how many parts a lively step is taken by how far bodies move in it: in so few that no body's stride
// (core/scene/pace.hpp) is longer in one of them, but in no more than `most`. Both are powers of two.
struct PartsByStride {
  std::uint32_t most = 1;
  float stride = 0.25F;
};

// A step of a scene whose masses are further apart than SoftSettings::even_masses.
struct UnevenStep {
  std::uint32_t parts = 1;  // equal ones, each of which detects anew
  SolveNumbers numbers;     // of a part in which such bodies touch
};

// core/method/rigid/SOLVERS.md has the measurements that the defaults were chosen by.
struct SoftSettings {
  // Where everything rests the fastest point is slow itself, and one point of a thousand kept all others sweeping. So a
  // change below a share of gravity ends the sweeps too.
  // A heap moves somewhere in nearly every step. To take back all that a push did, and to find the rest anew, took it
  // twice as many sweeps as to go on from where the push is kept, and it gained more energy. With 16 sweeps that
  // stop, 30,000 cubes that land gain too much.
  SolveNumbers even{4, 12, 0x1p-10F, 0x1p-5F, 6.0F, 24, 48, 0.25F, 0.25F, 1.0F};
  // The same where nothing moves fast (core/scene/pace.hpp): what overlaps at rest parts without any speed.
  SolveNumbers even_calm{4, 12, 0x1p-10F, 0x1p-5F, 6.0F, 16, 48, 0.25F};
  // Contacts that the start of a step shows tell little of where a thin body meets others once it has moved by its
  // thickness: dominoes that land ended up to a tenth of it deep. The parts share the step's substeps, so contacts are
  // detected more often and solved as often as in one.
  PartsByStride even_parts{4, 0.25F};
  // The same where fast bodies are followed on their ways (sweep.hpp). A body that is stopped on its way has given
  // others what it would have given them at its end; the shorter a part is, the less of that is wrong. Of 100 scenes of
  // fast bodies 6 gained energy with at most 4 parts.
  PartsByStride swept_parts{16, 0.25F};
  float even_masses = 64.0F;
  // A contact of a light body bears what a heavy one needs to stop. With a contact as stiff as the light body alone
  // allows, 8 kg at 9 m/s sank into 16 g by a quarter of its side, and sweeps that stop early leave as much. Parts,
  // because light bodies that are struck turn by half a radian within a step, and meet in points that its start does
  // not show.
  // Sweeps take back the push of a light body under a heavy one by the root of their ratio: with 48 a cube of 8 kg that
  // had come to rest on one of 16 g left it with 1.4 m/s.
  UnevenStep lively{4, {4, 1000, 1e-4F, 0x1p-5F, 200.0F, 24, 400}};
  // The same where nothing moves fast (core/scene/pace.hpp). What is solved less well sways.
  UnevenStep calm{1, {4, 500, 0x1p-8F, 0x1p-5F, 200.0F, 24, 400}};
  // For a calm step of few patches. What stands by a small margin has few contacts (an arch of 25 stones has 26
  // joints), so stiffer contacts and more sweeps cost little there.
  SolveNumbers few{4, 100, 0x1p-10F, 0x1p-5F, 20.0F};
  std::uint32_t few_patches = 128;
  float damping = 1.0F;
  PatchLimits limits{0x1p-16F, 0.0F};
  // Sweeps of what bounces once it has been stopped, at most: when three balls meet at once, two pairs share a ball,
  // and what the second pair does changes the first.
  std::uint32_t bounce_sweeps = 8;
  float fixed_bounce_from_m_s = 0.0F;  // 0 = twice what gravity gives in a step
};

// Catto's soft step, without conjugate directions. Its cost is known ahead, so what it pushes apart is relaxed once and
// not taken back (pushed_apart.hpp): one sweep leaves heaps a little deep in every substep, and on an H100 sweeping
// until little changes made a step of 1,000 resting cubes fifteen times as long. While something bounces, and sweeps go
// on anyway, pushes relax with it: otherwise heaps that land gain energy.
inline SoftSettings soft_step_settings() {
  SoftSettings settings;
  settings.even = settings.even_calm = settings.few = {8, 1, 0x1p-10F, 0x1p-5F, 1.2F, 8, 0, 0.0F, 1.0F};
  settings.even_parts.most = settings.swept_parts.most = 1;
  // Sweeps that stop follow no direction, so there are more.
  settings.lively = settings.calm = {1, {32, 1, 0x1p-10F, 0x1p-5F, 1.2F, 32}};
  return settings;
}

// So many substeps of a step in place of the solver's own; where masses are far apart as many times more as those have.
inline SoftSettings with_substeps(SoftSettings settings, std::uint32_t substeps) {
  const std::uint32_t own = settings.even.substeps;
  for (SolveNumbers* numbers :
       {&settings.even, &settings.even_calm, &settings.few, &settings.lively.numbers, &settings.calm.numbers})
    numbers->substeps = numbers->substeps * substeps / own;
  return settings;
}

// Stiffer contacts that are solved farther, for what stands by little: contacts of an arch of 25 stones yield by more
// than the 1 % by which it stands.
inline SoftSettings stiff_settings() {
  SoftSettings settings;
  settings.even = settings.even_calm = settings.few = {8, 100, 1e-5F, 0x1p-10F, 20.0F};
  return settings;
}

// What a step does at most: its substeps, and how often a substep adds to the velocities of a contact's bodies.
struct MostOfStep {
  std::uint32_t substeps = 0;
  std::uint32_t applications = 0;
};

BROADSIDE_HD constexpr const UnevenStep& uneven_step(const SoftSettings& settings, bool is_calm) {
  return is_calm ? settings.calm : settings.lively;
}
BROADSIDE_HD constexpr bool is_uneven(const SoftSettings& settings, float largest_mass_ratio) {
  return largest_mass_ratio > settings.even_masses;
}

// How a step is taken.
struct StepPlan {
  std::uint32_t parts = 1;  // equal ones, each of which detects anew
  bool is_uneven = false;   // masses are far apart
  bool is_calm = false;     // of such masses: nothing moves fast as the step begins
  friend bool operator==(const StepPlan&, const StepPlan&) = default;
};

BROADSIDE_HD constexpr std::uint32_t parts_for(const PartsByStride& rule, float stride) {
  std::uint32_t parts = 1;
  while (parts < rule.most && stride > rule.stride * static_cast<float>(parts)) parts *= 2;
  return parts;
}

constexpr const PartsByStride& parts_rule(const SoftSettings& settings, bool are_swept) {
  return are_swept ? settings.swept_parts : settings.even_parts;
}

// is_calm: as the step begins. stride: the largest of the bodies that move. are_swept: whether ways are followed.
constexpr StepPlan plan_of_step(const SoftSettings& settings, float largest_mass_ratio, bool is_calm, float stride,
                                bool are_swept) {
  const std::uint32_t by_stride = is_calm ? 1U : parts_for(parts_rule(settings, are_swept), stride);
  if (!is_uneven(settings, largest_mass_ratio)) return {by_stride, false, false};
  const std::uint32_t usual = uneven_step(settings, is_calm).parts;
  return {are_swept ? std::max(usual, by_stride) : usual, true, is_calm};
}
constexpr std::uint32_t most_parts(const SoftSettings& settings, float largest_mass_ratio, bool are_swept) {
  const std::uint32_t by_stride = parts_rule(settings, are_swept).most;
  if (!is_uneven(settings, largest_mass_ratio)) return by_stride;
  return std::max({settings.lively.parts, settings.calm.parts, are_swept ? by_stride : 1U});
}

// What a step, or its part, is solved with.
enum class SolveKind : std::uint8_t { kEven, kEvenCalm, kUneven, kFew };
inline constexpr SolveKind kSolveKinds[] = {SolveKind::kEven, SolveKind::kEvenCalm, SolveKind::kUneven,
                                            SolveKind::kFew};

// touching_ratio: the largest ratio of masses of two bodies that touch.
BROADSIDE_HD constexpr SolveKind solve_kind(const SoftSettings& settings, float touching_ratio, std::uint64_t patches,
                                            bool is_calm) {
  if (touching_ratio > settings.even_masses) return SolveKind::kUneven;
  if (!is_calm) return SolveKind::kEven;
  return patches <= settings.few_patches ? SolveKind::kFew : SolveKind::kEvenCalm;
}

// Of each part of the step.
constexpr SolveNumbers solve_numbers(const SoftSettings& settings, SolveKind kind, const StepPlan& plan) {
  if (kind == SolveKind::kEvenCalm) return settings.even_calm;
  if (kind == SolveKind::kFew) return settings.few;
  SolveNumbers numbers = kind == SolveKind::kUneven ? uneven_step(settings, plan.is_calm).numbers : settings.even;
  // The parts beyond those that the solver's numbers are for share their substeps.
  const std::uint32_t usual = plan.is_uneven ? uneven_step(settings, plan.is_calm).parts : 1U;
  numbers.substeps = std::max(1U, numbers.substeps * usual / plan.parts);
  return numbers;
}

// Whether sweeps go on with pushes that are kept. Without gravity nothing says which are small.
constexpr bool stirs_pushes(const SolveNumbers& numbers, float gravity_m_s2) {
  return numbers.stirred_of_small > 0.0F && gravity_m_s2 > 0.0F;
}
// Whether pushes are taken back. soft-step keeps them, because its cost must be known ahead.
constexpr bool takes_back_pushes(const SolveNumbers& numbers, float gravity_m_s2) {
  return numbers.sweeps > 1 && !stirs_pushes(numbers, gravity_m_s2);
}

inline MostOfStep most_of_step(const SoftSettings& settings, float largest_mass_ratio, bool may_bounce,
                               bool are_swept) {
  const auto most_of = [&](std::uint32_t parts, const SolveNumbers& numbers) {
    // Sweeps, of which several have a step along the direction between two.
    const auto of_sweeps = [&](std::uint32_t sweeps) { return numbers.sweeps > 1 ? 2 * sweeps - 1 : sweeps; };
    // The start from the last impulse, sweeps and relaxation.
    std::uint32_t applications = 1 + of_sweeps(numbers.sweeps) + 1;
    // What pushes apart may be taken back: a start without it, and what changes by that relaxes.
    if (numbers.sweeps > 1) applications += 1 + of_sweeps(numbers.relax_sweeps);
    // Before a bounce all relaxes; a sweep of it visits a patch's points several times, and its friction.
    if (may_bounce) applications += of_sweeps(numbers.stop_sweeps) + settings.bounce_sweeps * (kSweepsOfBounce + 1);
    return MostOfStep{parts * numbers.substeps, applications};
  };
  const auto larger = [](const MostOfStep& a, const MostOfStep& b) {
    return MostOfStep{std::max(a.substeps, b.substeps), std::max(a.applications, b.applications)};
  };
  MostOfStep most = larger(larger(most_of(1, settings.even), most_of(1, settings.even_calm)), most_of(1, settings.few));
  most.substeps = std::max(most.substeps, most_parts(settings, largest_mass_ratio, are_swept));
  if (!is_uneven(settings, largest_mass_ratio)) return most;
  const MostOfStep of_lively =
      larger(most_of(settings.lively.parts, settings.lively.numbers), most_of(settings.lively.parts, settings.even));
  return larger(larger(most, of_lively), most_of(settings.calm.parts, settings.calm.numbers));
}

// dt_s: of the step, or of its part.
inline SoftStep soft_step_of(const SoftSettings& settings, Vec3 gravity_m_s2, float dt_s, const SolveNumbers& numbers) {
  constexpr float kSettleShare = 0.05F;
  // A push that stays as speed leaves a sixteenth of what explicit and implicit Euler differ by in a step.
  constexpr float kSmallPushShare = 0.25F;
  const float gravity = length(gravity_m_s2);
  SoftStep step = soft_step(dt_s / static_cast<float>(numbers.substeps), numbers.omega_dt, settings.damping);
  step.most_sweeps = numbers.sweeps;
  step.done_share = numbers.done;
  step.most_relax_sweeps = numbers.relax_sweeps;
  step.most_stop_sweeps = numbers.stop_sweeps;
  step.most_bounce_sweeps = settings.bounce_sweeps;
  step.gravity_m_s2 = gravity;
  step.least_done_m_s = numbers.done_of_gravity * gravity * step.dt_s;
  step.settle_m_s = kSettleShare * gravity * step.dt_s;
  step.bounce_from_m_s = settings.fixed_bounce_from_m_s > 0.0F ? settings.fixed_bounce_from_m_s : 2.0F * dt_s * gravity;
  const float small_m_s = kSmallPushShare * gravity * dt_s;
  if (takes_back_pushes(numbers, gravity)) {
    step.kept_push_m_s = small_m_s;
    step.least_relax_m_s = numbers.relax_done_of_small * small_m_s;
  }
  if (stirs_pushes(numbers, gravity)) {
    step.stirring_m_s = numbers.stirred_of_small * small_m_s;
    if (numbers.begins_of_small > 0.0F) step.begins_m_s = numbers.begins_of_small * small_m_s;
  }
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
  // Without gravity only the step says what is fast.
  constexpr float kPushShare = 1.0F / 64.0F;
  const float reach = reach_of(c, a, b);
  c.slop_m = limits.fixed_slop_m > 0.0F ? limits.fixed_slop_m : limits.slop_share * reach;
  c.fastest_push_m_s = kPushShare * reach / dt_s;
}

}  // namespace broadside::core

// The settings of the soft solver, and the numbers of a step that follow from them.
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

// Which lengths of a patch count as small.
struct PatchLimits {
  float slop_share = 0.0F;    // of the patch's reach
  float fixed_slop_m = 0.0F;  // replaces slop_share where it is set
};

// The numbers that contacts are solved with in a step, or in a part of one.
struct SolveNumbers {
  std::uint32_t substeps = 1;
  // At most so many in a substep. One sweep is Catto's soft step; with more, steps along conjugate directions lie
  // between them.
  std::uint32_t sweeps = 1;
  // Sweeps end with one that changes no point's speed by more than this share of the fastest speed, or by more than
  // this share of the speed that gravity gives in a substep.
  float done = 0.0F;
  float done_of_gravity = 0.0F;
  float omega_dt = 0.0F;  // soft_step of soft_contact.hpp
  // The most sweeps, in a substep in which something bounces, that stop the points that approached fast. Without this
  // limit a heap that lands would take hundreds.
  std::uint32_t stop_sweeps = 16;
  // The most sweeps, in a substep whose pushes are taken back, that solve for the impulses that remain.
  std::uint32_t relax_sweeps = 48;
  // These sweeps end with one that changes no point's speed by more than this share of a small push.
  float relax_done_of_small = 0.0F;
  // Where pushes are kept: patches that relaxation changes by more than this share of a small push are swept with those
  // that bounce, until they change by less; 0: none are.
  float stirred_of_small = 0.0F;
  // These patches are swept also where nothing bounces, once relaxation changes one of them by more than this share of
  // a small push; 0: never.
  float begins_of_small = 0.0F;
};

// In how many parts a lively step is taken: the fewest in which no body's stride (core/scene/pace.hpp) is longer than
// `stride`, but no more than `most`. Both are powers of two.
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
  // Where everything rests, even the fastest point is slow, and one point in a thousand kept all others sweeping. So a
  // change below a share of the speed that gravity gives ends the sweeps too. A heap moves somewhere in nearly every
  // step. Taking back all effects of a push, and solving again without it, took twice as many sweeps as keeping the
  // push and going on from there, and the heap gained more energy. With 16 sweeps that stop, 30,000 cubes that land
  // gain too much energy.
  SolveNumbers even{4, 12, 0x1p-10F, 0x1p-5F, 6.0F, 24, 48, 0.25F, 0.25F, 1.0F};
  // The same where nothing moves fast (core/scene/pace.hpp): what overlaps at rest parts without any speed.
  SolveNumbers even_calm{4, 12, 0x1p-10F, 0x1p-5F, 6.0F, 16, 48, 0.25F};
  // Once a thin body has moved by its thickness, the contacts found at the start of the step tell little of where it
  // meets others: dominoes that land ended up to a tenth of their thickness deep. The parts share the step's substeps,
  // so contacts are detected more often and solved as often as in one.
  PartsByStride even_parts{4, 0.25F};
  // The same where fast bodies are followed on their ways (sweep.hpp). A body that is stopped on its way has already
  // given others the impulses of the whole way; the shorter a part is, the smaller this error is. Of 100 scenes of fast
  // bodies 6 gained energy with at most 4 parts.
  PartsByStride swept_parts{16, 0.25F};
  float even_masses = 64.0F;
  // A contact of a light body must bear the impulse that stops a heavy one. With a contact as stiff as the light body
  // alone allows, 8 kg at 9 m/s sank into 16 g by a quarter of its side, and sweeps that stop early leave as much. The
  // step has parts, because light bodies that are struck turn by half a radian within a step, and touch at points that
  // its start does not show. The number of sweeps that take back a push of a light body under a heavy one grows with
  // the root of the ratio of their masses: with 48 sweeps a cube of 8 kg that had come to rest on one of 16 g left it
  // at 1.4 m/s.
  UnevenStep lively{4, {4, 1000, 1e-4F, 0x1p-5F, 200.0F, 24, 400}};
  // The same where nothing moves fast (core/scene/pace.hpp). With a coarser solution, stacks sway.
  UnevenStep calm{1, {4, 500, 0x1p-8F, 0x1p-5F, 200.0F, 24, 400}};
  // For a calm step of few patches. Structures that stand by a small margin have few contacts (an arch of 25 stones has
  // 26 joints), so stiffer contacts and more sweeps cost little there.
  SolveNumbers few{4, 100, 0x1p-10F, 0x1p-5F, 20.0F};
  std::uint32_t few_patches = 128;
  float damping = 1.0F;
  PatchLimits limits{0x1p-16F, 0.0F};
  // The most sweeps over patches that bounce, once they have been stopped: when three balls meet at once, two pairs
  // share a ball, and solving the second pair changes the first.
  std::uint32_t bounce_sweeps = 8;
  float fixed_bounce_from_m_s = 0.0F;  // 0 = twice what gravity gives in a step
};

// Catto's soft step, without conjugate directions. Its cost is known ahead, so what it pushes apart is relaxed once and
// not taken back (pushed_apart.hpp): one sweep leaves heaps a little deep in every substep, and on an H100 sweeping
// until little changes made a step of 1,000 resting cubes fifteen times as long. While something bounces, sweeps go on
// anyway, and patches that were pushed apart are swept with those that bounce: otherwise heaps that land gain energy.
inline SoftSettings soft_step_settings() {
  SoftSettings settings;
  settings.even = settings.even_calm = settings.few = {8, 1, 0x1p-10F, 0x1p-5F, 1.2F, 8, 0, 0.0F, 1.0F};
  settings.even_parts.most = settings.swept_parts.most = 1;
  // The sweeps that stop bodies follow no conjugate direction here, so there are more of them.
  settings.lively = settings.calm = {1, {32, 1, 0x1p-10F, 0x1p-5F, 1.2F, 32}};
  return settings;
}

// The settings with this number of substeps in place of the solver's own. Other numbers of substeps, such as those for
// masses that are far apart, are scaled by the same factor.
inline SoftSettings with_substeps(SoftSettings settings, std::uint32_t substeps) {
  const std::uint32_t own = settings.even.substeps;
  for (SolveNumbers* numbers :
       {&settings.even, &settings.even_calm, &settings.few, &settings.lively.numbers, &settings.calm.numbers})
    numbers->substeps = numbers->substeps * substeps / own;
  return settings;
}

// Stiffer contacts that are solved more exactly, for structures that stand by a small margin: otherwise contacts of an
// arch of 25 stones yield by more than the 1 % by which it stands.
inline SoftSettings stiff_settings() {
  SoftSettings settings;
  settings.even = settings.even_calm = settings.few = {8, 100, 1e-5F, 0x1p-10F, 20.0F};
  return settings;
}

// The most work of a step: its substeps, and how often a substep adds to the velocities of a contact's bodies.
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

// The set of numbers that a step, or a part of it, is solved with.
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

// The numbers of each part of the step.
constexpr SolveNumbers solve_numbers(const SoftSettings& settings, SolveKind kind, const StepPlan& plan) {
  if (kind == SolveKind::kEvenCalm) return settings.even_calm;
  if (kind == SolveKind::kFew) return settings.few;
  SolveNumbers numbers = kind == SolveKind::kUneven ? uneven_step(settings, plan.is_calm).numbers : settings.even;
  // The solver's numbers are for the usual number of parts; if there are more, they share the substeps.
  const std::uint32_t usual = plan.is_uneven ? uneven_step(settings, plan.is_calm).parts : 1U;
  numbers.substeps = std::max(1U, numbers.substeps * usual / plan.parts);
  return numbers;
}

// Whether sweeps go on with pushes that are kept. Without gravity they do not, because nothing says which pushes are
// small.
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
    // Sweeps; if there are several, a step along a conjugate direction lies between each two.
    const auto of_sweeps = [&](std::uint32_t sweeps) { return numbers.sweeps > 1 ? 2 * sweeps - 1 : sweeps; };
    // The warm start, the sweeps and one relaxation.
    std::uint32_t applications = 1 + of_sweeps(numbers.sweeps) + 1;
    // Pushes may be taken back: a start without them, and sweeps that relax what this changes.
    if (numbers.sweeps > 1) applications += 1 + of_sweeps(numbers.relax_sweeps);
    // Before a bounce, sweeps stop the bodies. A sweep of the bounce visits a patch's points several times, and its
    // friction once.
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
  // The energy of a push that is kept as speed, m (g h / 4)^2 / 2, is then at most a sixteenth of m g^2 h^2 / 2, by
  // which explicit and implicit Euler differ in a step.
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

// The larger of two masses over the smaller; 1 where one of the bodies never moves.
BROADSIDE_HD constexpr float mass_ratio(float inverse_mass_a, float inverse_mass_b) {
  if (!(inverse_mass_a > 0.0F) || !(inverse_mass_b > 0.0F)) return 1.0F;
  return inverse_mass_a > inverse_mass_b ? inverse_mass_a / inverse_mass_b : inverse_mass_b / inverse_mass_a;
}

// dt_s: of the step.
BROADSIDE_HD void set_limits(PatchConstraint& c, const SolverBody& a, const SolverBody& b, const PatchLimits& limits,
                             float dt_s) {
  // Without gravity, only the length of the step says which speed is fast.
  constexpr float kPushShare = 1.0F / 64.0F;
  const float reach = reach_of(c, a, b);
  c.slop_m = limits.fixed_slop_m > 0.0F ? limits.fixed_slop_m : limits.slop_share * reach;
  c.fastest_push_m_s = kPushShare * reach / dt_s;
}

}  // namespace broadside::core

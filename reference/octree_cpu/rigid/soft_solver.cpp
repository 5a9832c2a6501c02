#include "reference/octree_cpu/rigid/soft_solver.hpp"

#include <algorithm>
#include <cstddef>

#include "core/contact.hpp"
#include "core/math/order_free_sum.hpp"
#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/kept_blows.hpp"

namespace broadside::reference {

namespace {

// The largest ratio of the masses of two moved bodies that touch; at least 1.
float largest_mass_ratio(std::span<const core::ContactPatch> patches, std::span<const core::RigidMass> masses) {
  float largest = 1.0F;
  for (const core::ContactPatch& patch : patches) {
    if (core::is_face(patch.b)) continue;
    largest = std::max(largest, core::mass_ratio(masses[patch.a].inverse_mass, masses[patch.b].inverse_mass));
  }
  return largest;
}

}  // namespace

float SoftSolver::largest_speed() const {
  return speeds_.empty() ? 0.0F : *std::max_element(speeds_.begin(), speeds_.end());
}

float SoftSolver::sweep_until_done(const core::SoftStep& numbers) {
  speeds_.assign(work_.tiles().count(), 0.0F);
  changes_.assign(work_.tiles().places(), 0.0F);
  pushes_.assign(work_.tiles().places(), 0.0F);
  work_.each_range(
      [&](const TileRange& range) { kernels_.begin_sweeps(range, numbers, speeds_.data(), pushes_.data()); });
  work_.note_pushed(pushes_, numbers);
  const float done = core::done_m_s(numbers, numbers.done_share, largest_speed());
  work_.each_range_by_color([&](const TileRange& range) { kernels_.warm_start(range); });
  SweepWay way{core::has_directions(numbers), true, 0.0F, speeds_.data(), changes_.data()};
  core::DirectionShare share;
  for (std::uint32_t k = 1;; ++k) {
    work_.each_range_by_color([&](const TileRange& range) { kernels_.sweep(range, numbers, way); });
    ++sweeps_done_;
    // The last change is a sweep's, not a step along directions, because a sweep leaves every impulse in its friction
    // cone.
    if (k >= numbers.most_sweeps || largest_speed() <= done) return done;
    way.is_first = false;
    way.share = share.after(core::order_free_sum(changes_));
    work_.each_range_by_color([&](const TileRange& range) { kernels_.push_along(range, way.share); });
  }
}

void SoftSolver::relax(const core::SoftStep& numbers) {
  if (work_.is_pushed()) {
    work_.take_back_impulses();
    work_.each_range_by_color([&](const TileRange& range) { kernels_.warm_start(range); });
  }
  relaxed_.resize(work_.tiles().places());
  work_.each_range_by_color([&](const TileRange& range) { kernels_.relax(range, numbers, relaxed_.data()); });
  if (work_.is_pushed()) sweeps_done_ += work_.relax_pushed(numbers);
}

void SoftSolver::substep(const RigidStep& step, const core::SoftStep& numbers, core::SolveKind kind) {
  const auto bodies = work_.bodies();
  work_.each_body([&](std::size_t i) {
    core::accelerate(bodies[i], step.gravity_m_s2, step.wrenches.empty() ? nullptr : &step.wrenches[i], numbers.dt_s);
  });
  const float done = sweep_until_done(numbers);
  core::SoftStep after = numbers;
  if (core::has_directions(numbers)) core::sweep_on_from(after, done, work_.is_pushed());
  work_.each_body([&](std::size_t i) { core::move(bodies[i], step.masses[i], numbers.dt_s); });
  relax(numbers);
  work_.bounce(after, relaxed_, core::forgets_blows(kind));
  work_.each_range([&](const TileRange& range) { kernels_.end_substep(range); });
}

core::StepPlan SoftSolver::plan_of_step(float largest_mass_ratio, bool is_calm, float stride, bool are_swept) const {
  return core::plan_of_step(settings_, largest_mass_ratio, is_calm, stride, are_swept);
}

void SoftSolver::advance(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches,
                         const RigidStep& step) {
  const core::SolveKind kind =
      core::solve_kind(settings_, largest_mass_ratio(patches, step.masses), patches.size(), step.is_calm);
  const core::SolveNumbers solve = core::solve_numbers(settings_, kind, step.plan);
  const core::SoftStep numbers = core::soft_step_of(settings_, step.gravity_m_s2, step.dt_s, solve);
  work_.begin(states, patches, step, numbers, settings_.limits);
  for (std::uint32_t k = 0; k < solve.substeps; ++k) substep(step, numbers, kind);
  work_.finish(states, patches, step, solve.substeps);
}

}  // namespace broadside::reference

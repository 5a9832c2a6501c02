#include "reference/octree_cpu/rigid/soft_solver.hpp"

#include <algorithm>
#include <cstddef>

#include "core/contact.hpp"
#include "core/math/order_free_sum.hpp"

namespace broadside::reference {

using core::PatchConstraint;
using core::SolverBody;

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

float SoftSolver::largest_of_patches() const {
  return of_patches_.empty() ? 0.0F : *std::max_element(of_patches_.begin(), of_patches_.end());
}

// Adds to the impulses what the last directions suggest.
void SoftSolver::follow_direction() {
  work_.each_patch([&](const PatchConstraint& c, const SolverBody&, const SolverBody&) {
    of_patches_[work_.index_of(c)] = core::squared_change(c, ways_[work_.index_of(c)]);
  });
  const core::OrderFreeSum sum(largest_of_patches());
  std::uint64_t units = 0;
  for (const float part : of_patches_) units += sum.units(part);
  const float change = sum.value(units);
  if (!(last_change_ > 0.0F)) first_change_ = change;
  const float share = core::share_of_direction(first_change_, last_change_, change);
  last_change_ = change;
  work_.each_patch_by_color([&](PatchConstraint& c, SolverBody& a, SolverBody& b) {
    core::PatchWay& way = ways_[work_.index_of(c)];
    core::push_along(c, way, a, b, share);
    core::follow_impulses(c, way, share);
  });
}

void SoftSolver::sweep_until_done(const core::SoftStep& numbers) {
  of_patches_.assign(work_.patches().size(), 0.0F);
  ways_.assign(work_.patches().size(), {});
  last_change_ = 0.0F;
  work_.each_patch([&](const PatchConstraint& c, const SolverBody& a, const SolverBody& b) {
    of_patches_[work_.index_of(c)] = core::fastest_point(c, core::motion_of(a, b));
  });
  const float done = core::done_m_s(numbers, settings_.done, largest_of_patches());
  work_.each_patch_by_color([](PatchConstraint& c, SolverBody& a, SolverBody& b) { core::warm_start(c, a, b); });
  for (std::uint32_t k = 1;; ++k) {
    work_.each_patch_by_color([&](PatchConstraint& c, SolverBody& a, SolverBody& b) {
      const std::size_t index = work_.index_of(c);
      core::note_impulses(c, ways_[index]);
      of_patches_[index] = core::solve_patch(c, core::goals_of(c, a, b, numbers), a, b, numbers);
    });
    ++sweeps_done_;
    // The last word is a sweep's: it leaves every impulse in its cone.
    if (k >= settings_.sweeps || largest_of_patches() <= done) return;
    follow_direction();
  }
}

void SoftSolver::substep(const RigidStep& step, const core::SoftStep& numbers) {
  const auto bodies = work_.bodies();
  if (work_.may_bounce())
    work_.each_patch([](PatchConstraint& c, const SolverBody& a, const SolverBody& b) {
      core::note_approach(c, core::motion_of(a, b));
    });
  work_.each_body([&](std::size_t i) {
    core::accelerate(bodies[i], step.gravity_m_s2, step.wrenches.empty() ? nullptr : &step.wrenches[i], numbers.dt_s);
  });
  sweep_until_done(numbers);
  work_.each_body([&](std::size_t i) { core::move(bodies[i], step.masses[i], numbers.dt_s); });
  work_.each_patch_by_color([&](PatchConstraint& c, SolverBody& a, SolverBody& b) {
    core::relax_patch(c, core::goals_after_motion(c, a, b, numbers), a, b);
  });
  work_.bounce(numbers);
  work_.each_patch([&](PatchConstraint& c, const SolverBody&, const SolverBody&) {
    core::add_to_totals(c);
    core::drop_impacts(c, numbers);
  });
}

void SoftSolver::advance(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches,
                         const RigidStep& step) {
  const bool is_uneven = largest_mass_ratio(patches, step.masses) > settings_.even_masses;
  const std::uint32_t substeps = core::substeps_of(settings_, is_uneven);
  const core::SoftStep numbers = core::soft_step_of(settings_, step.gravity_m_s2, step.dt_s, substeps);
  work_.begin(states, patches, step, numbers.dt_s, settings_.limits);
  for (std::uint32_t k = 0; k < substeps; ++k) substep(step, numbers);
  work_.finish(states, patches);
}

}  // namespace broadside::reference

#include "reference/octree_cpu/rigid/soft_solver.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "core/contact.hpp"

namespace broadside::reference {
namespace {

using core::PatchConstraint;
using core::PatchPoint;
using core::SolverBody;

// Below this many, handing work to threads costs more than doing it: a patch or a body takes some hundred nanoseconds,
// waking a worker some microseconds.
constexpr std::size_t kPerTask = 64;

template <typename Work>
void in_parallel(std::size_t first, std::size_t last, const Work& work) {
  if (last - first < 2 * kPerTask) {
    for (std::size_t k = first; k < last; ++k) work(k);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last, kPerTask), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) work(k);
  });
}

}  // namespace

template <typename Work>
void SoftSolver::each_patch(const Work& work) {
  const auto begin = coloring_.color_begin();
  for (std::uint32_t color = 0; color < coloring_.color_count(); ++color)
    in_parallel(begin[color], begin[color + 1], [&](std::size_t k) {
      PatchConstraint& c = constraints_[k];
      work(c, bodies_[c.a], bodies_[c.b]);
    });
}

template <typename Work>
void SoftSolver::each_body(const Work& work) {
  in_parallel(0, bodies_.size() - 1, work);
}

core::SoftStep SoftSolver::numbers_of(const RigidStep& step) const {
  core::SoftStep numbers =
      core::soft_step(step.dt_s / static_cast<float>(options_.substeps), options_.omega_dt, options_.damping);
  numbers.fastest_push_m_s = options_.fastest_push_m_s;
  numbers.slop_m = options_.slop_m;
  numbers.bounce_from_m_s =
      options_.bounce_from_m_s > 0.0F ? options_.bounce_from_m_s : 2.0F * step.dt_s * core::length(step.gravity_m_s2);
  return numbers;
}

// The impulses that these two bodies gave each other in the last substep of the step before.
void SoftSolver::recall(const core::ContactPatch& patch, PatchConstraint& c) const {
  const auto remembered = memory_.of(patch.a, patch.b);
  for (int k = 0; k < c.count; ++k) {
    PatchPoint& p = c.points[k];
    const auto same = std::find_if(remembered.begin(), remembered.end(), [&](const RememberedPoint& r) {
      return r.feature == patch.manifold.points[k].feature;
    });
    if (same == remembered.end()) continue;
    p.normal_impulse = substep_s_ * same->normal_n;
    p.tangent_impulse_1 = substep_s_ * core::dot(same->friction_n, c.tangent_1);
    p.tangent_impulse_2 = substep_s_ * core::dot(same->friction_n, c.tangent_2);
  }
}

void SoftSolver::begin(std::span<const core::RigidState> states, std::span<const core::ContactPatch> patches,
                       const RigidStep& step) {
  bodies_.resize(states.size() + 1);
  bodies_.back() = {};
  each_body([&](std::size_t i) { bodies_[i] = core::solver_body(states[i], step.masses[i]); });
  coloring_.color(patches, step.masses);
  constraints_.resize(patches.size());
  std::atomic<bool> bouncing = false;
  in_parallel(0, patches.size(), [&](std::size_t place) {
    const core::ContactPatch& patch = patches[coloring_.order()[place]];
    const bool is_face = core::is_face(patch.b);
    const auto b = is_face ? static_cast<std::uint32_t>(states.size()) : patch.b;
    const core::Material surface =
        core::combine(step.materials[patch.a], is_face ? step.face_material : step.materials[patch.b]);
    const core::Vec3 across = is_face ? core::Vec3{} : states[patch.b].x - states[patch.a].x;
    PatchConstraint& c = constraints_[place];
    c = core::make_constraint(patch.manifold, bodies_[patch.a], bodies_[b], across, surface);
    c.a = patch.a;
    c.b = b;
    recall(patch, c);
    if (surface.restitution > 0.0F) bouncing.store(true, std::memory_order_relaxed);
  });
  has_bouncing_surface_ = bouncing;
}

void SoftSolver::substep(const RigidStep& step, const core::SoftStep& numbers) {
  if (has_bouncing_surface_)
    in_parallel(0, constraints_.size(), [&](std::size_t k) {
      core::note_approach(constraints_[k], bodies_[constraints_[k].a], bodies_[constraints_[k].b]);
    });
  each_body([&](std::size_t i) {
    core::accelerate(bodies_[i], step.gravity_m_s2, step.wrenches.empty() ? nullptr : &step.wrenches[i], numbers.dt_s);
  });
  each_patch([](PatchConstraint& c, SolverBody& a, SolverBody& b) { core::warm_start(c, a, b); });
  each_patch([&](PatchConstraint& c, SolverBody& a, SolverBody& b) { core::solve_patch(c, a, b, numbers, true); });
  each_body([&](std::size_t i) { core::move(bodies_[i], step.masses[i], numbers.dt_s); });
  for (std::uint32_t k = 0; k < options_.relax_sweeps; ++k)
    each_patch([&](PatchConstraint& c, SolverBody& a, SolverBody& b) { core::solve_patch(c, a, b, numbers, false); });
  if (has_bouncing_surface_)
    each_patch([&](PatchConstraint& c, SolverBody& a, SolverBody& b) {
      if (core::bounces(c, numbers)) core::bounce(c, a, b, numbers);
    });
  in_parallel(0, constraints_.size(), [&](std::size_t k) { core::add_to_totals(constraints_[k], numbers); });
}

void SoftSolver::finish(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches) {
  each_body([&](std::size_t i) { states[i] = core::state_after(bodies_[i], states[i]); });
  memory_.begin(patches);
  impulses_.resize(patches.size());
  const float per_s = 1.0F / substep_s_;
  in_parallel(0, constraints_.size(), [&](std::size_t place) {
    const std::uint32_t patch = coloring_.order()[place];
    const PatchConstraint& c = constraints_[place];
    impulses_[patch] = {};
    for (int k = 0; k < c.count; ++k) {
      const PatchPoint& p = c.points[k];
      impulses_[patch][static_cast<std::size_t>(k)] = core::total_impulse(c, p);
      const core::Vec3 friction = p.tangent_impulse_1 * c.tangent_1 + p.tangent_impulse_2 * c.tangent_2;
      memory_.keep(patch, k, {patches[patch].manifold.points[k].feature, per_s * p.normal_impulse, per_s * friction});
    }
  });
}

void SoftSolver::advance(std::span<core::RigidState> states, std::span<const core::ContactPatch> patches,
                         const RigidStep& step) {
  const core::SoftStep numbers = numbers_of(step);
  substep_s_ = numbers.dt_s;
  begin(states, patches, step);
  for (std::uint32_t k = 0; k < options_.substeps; ++k) substep(step, numbers);
  finish(states, patches);
}

}  // namespace broadside::reference

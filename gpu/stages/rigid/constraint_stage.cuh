// Before and after the substeps: makes constraints of patches, with the impulses that the step before left, and keeps
// what the step leaves. The same as reference/octree_cpu/rigid/step_constraints.cpp.
#pragma once

#include "core/method/rigid/patch_constraint.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "core/method/rigid/unpushed_body.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/constraint_tiles.cuh"
#include "gpu/stages/rigid/contact_body.cuh"
#include "gpu/stages/rigid/patch_entries.cuh"
#include "gpu/stages/rigid/solver_bodies.cuh"

namespace broadside::gpu {

// For each point of a patch: the first point with the same feature that its two bodies had in the step before, in the
// order of patches and points; kForgotten if there is none.
constexpr std::uint32_t kForgotten = 0xFFFFFFFFU;
struct RememberedPoints {
  std::uint32_t at[kFourPoints] = {kForgotten, kForgotten, kForgotten, kForgotten};
};
__device__ inline RememberedPoints remembered_points(const RigidFrameView& f, const core::ContactPatch& patch) {
  const std::uint32_t body = is_moved(f, patch.a) ? patch.a : patch.b;
  const std::uint32_t other = body == patch.a ? patch.b : patch.a;
  RememberedPoints found;
  each_entry(f.old_memory, body, [&](const PatchEntry& entry) {
    if (entry.other != other) return;
#pragma unroll
    for (std::uint32_t old = 0; old < kFourPoints; ++old) {
      const std::uint32_t point = kFourPoints * entry.patch + old;
      const std::uint32_t feature = f.old_memory.feature[point];
#pragma unroll
      for (std::uint32_t k = 0; k < kFourPoints; ++k)
        if (patch.manifold.points[k].feature == feature) found.at[k] = min(found.at[k], point);
    }
  });
  return found;
}

__device__ inline void recall(const RigidFrameView& f, const core::SoftStep& soft, const core::ContactPatch& patch,
                              core::PatchConstraint& c) {
  const RememberedPoints remembered = remembered_points(f, patch);
  core::each_point(c, [&](int k) {
    if (remembered.at[k] == kForgotten) return;
    const PackedVec3 impulse = f.old_memory.impulse[remembered.at[k]];
    core::PatchPoint& p = c.points[k];
    p.normal_impulse = soft.dt_s * impulse.w;
    p.tangent_impulse_1 = soft.dt_s * core::dot(impulse.v, c.tangent_1);
    p.tangent_impulse_2 = soft.dt_s * core::dot(impulse.v, c.tangent_2);
  });
}

// The core::SolveKind of the step: the index of its numbers in f.soft and f.substeps.
__device__ inline int step_kind(const RigidFrameView& f) {
  const bool is_calm = __uint_as_float(f.counts->fastest_m_s) <= f.calm_m_s;
  const float ratio = __uint_as_float(f.counts->mass_ratio);
  return static_cast<int>(core::solve_kind(f.solver, ratio, f.counts->patches, is_calm));
}

template <typename Team>
__device__ void make_constraints(const Team& team, const RigidFrameView& f) {
  const core::SoftStep soft = f.soft[step_kind(f)];
  bool bounces = false;
  for (std::uint64_t place = team.rank(); place < f.counts->places; place += team.size()) {
    if (f.patch_at[place] == kUncolored) continue;
    const core::ContactPatch patch = f.patches.items[f.patch_at[place]];
    const bool is_face = core::is_face(patch.b);
    const std::uint32_t b = is_face ? f.body_count : patch.b;
    const core::Material surface = core::combine(f.material[patch.a], is_face ? f.face_material : f.material[patch.b]);
    const core::Vec3 across = is_face ? core::Vec3{} : f.before[patch.b].x - f.before[patch.a].x;
    const core::SolverBody body_a = load_body(f, patch.a);
    const core::SolverBody body_b = load_body(f, b);
    core::PatchConstraint c = core::make_constraint(patch.manifold, body_a, body_b, across, surface);
    c.a = patch.a;
    c.b = b;
    core::set_limits(c, body_a, body_b, f.solver.limits, f.dt_s);
    recall(f, soft, patch, c);
    bounces = core::note_approach(c, body_a, body_b, soft) || bounces;
    store_constraint(TileSlot(f.constraints, place), c, across, body_a, body_b);
  }
  __syncwarp();
  if (__any_sync(kFullWarp, bounces) && lane() == 0) atomicMax(&f.counts->bounces, 1U);
}

// Includes the impulses of the last substep, which are not in the totals yet.
__device__ inline void load_all_given(const TileSlot& slot, core::PatchConstraint& c) {
  load_bodies(slot, c);
  load_directions(slot, c);
  load_impulses(slot, c);
  load_totals(slot, c);
  core::add_to_totals(c);
}

// Whether a patch of the body gave it an impulse in this step.
__device__ inline bool is_pushed_body(const RigidFrameView& f, std::uint32_t i) {
  const std::uint32_t* places = f.by_color + f.memory.begin[i];
  for (std::uint32_t k = 0; k < f.memory.count[i]; ++k) {
    core::PatchConstraint c;
    load_all_given(TileSlot(f.constraints, places[k] / 2), c);
    if (core::has_pushed(c)) return true;
  }
  return false;
}

template <typename Team>
__device__ void finish_bodies(const Team& team, const RigidFrameView& f) {
  const int kind = step_kind(f);
  for (std::uint64_t k = team.spread_rank(); k < f.body_count; k += team.size()) {
    const auto i = static_cast<std::uint32_t>(k);
    core::SolverBody body = load_body(f, i);
    // core::is_moved is false for a sleeping body, whose patches are not among the constraints.
    if (core::is_moved(body) && !is_pushed_body(f, i))
      core::forget_pushes(body, f.before[i], f.gravity_m_s2, f.wrench == nullptr ? nullptr : f.wrench + i,
                          f.soft[kind].dt_s, f.substeps[kind]);
    f.after[i] = core::state_after(body, f.before[i]);
  }
}

// Writes the impulses of the step for the trace, and those of the last substep for the next step.
template <typename Team>
__device__ void finish_patches(const Team& team, const RigidFrameView& f) {
  const core::SoftStep soft = f.soft[step_kind(f)];
  const float per_s = 1.0F / soft.dt_s;
  for (std::uint64_t place = team.spread_rank(); place < f.counts->places; place += team.size()) {
    const std::uint32_t patch = f.patch_at[place];
    if (patch == kUncolored) continue;
    core::PatchConstraint c;
    load_all_given(TileSlot(f.constraints, place), c);
    const std::uint64_t first = std::uint64_t{kFourPoints} * patch;
    // Points that the patch does not have get zeros: the host copies all four.
#pragma unroll
    for (std::uint32_t k = 0; k < kFourPoints; ++k) {
      const bool is_used = static_cast<int>(k) < c.count;
      f.memory.feature[first + k] = is_used ? f.patches.items[patch].manifold.points[k].feature : 0;
      if (!is_used) f.impulses[first + k] = core::Vec3{};
    }
    core::each_point(c, [&](int k) {
      const core::PatchPoint& p = c.points[k];
      const std::uint64_t at = first + static_cast<std::uint64_t>(k);
      f.impulses[at] = core::total_impulse(c, p);
      const core::Vec3 friction = p.tangent_impulse_1 * c.tangent_1 + p.tangent_impulse_2 * c.tangent_2;
      f.memory.impulse[at] = {per_s * friction, per_s * p.normal_impulse};
    });
  }
}

}  // namespace broadside::gpu

// The substeps of a step, with the sweeps of core/method/rigid/soft_contact.hpp: color by color, a thread a patch. The
// same loop as reference/octree_cpu/rigid/soft_solver.cpp.
#pragma once

#include "core/method/rigid/soft_contact.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/constraint_tiles.cuh"
#include "gpu/stages/rigid/place_stage.cuh"
#include "gpu/stages/rigid/solver_bodies.cuh"

namespace broadside::gpu {

template <typename Team, typename Work>
__device__ void each_body(const Team& team, const RigidFrameView& f, const Work& work) {
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) work(static_cast<std::uint32_t>(i));
  team.sync();
}

// work(slot, constraint) for every patch, in any order: it reads bodies alone.
template <typename Team, typename Work>
__device__ void each_patch(const Team& team, const RigidFrameView& f, const Work& work) {
  for (std::uint64_t place = team.rank(); place < f.counts->places; place += team.size()) {
    if (f.patch_at[place] == kUncolored) continue;
    const TileSlot slot(f.constraints, place);
    core::PatchConstraint c = load_bodies_and_points(slot);
    work(slot, c);
  }
  team.sync();
}

// work(slot, constraint, a, b) color by color; what it makes of the bodies' velocities is stored.
template <typename Team, typename Work>
__device__ void each_patch_by_color(const Team& team, const RigidFrameView& f, const Work& work) {
  for (std::uint32_t color = 0; color < f.counts->colors; ++color) {
    const std::uint64_t end = std::uint64_t{f.color_begin[color]} + f.color_count[color];
    for (std::uint64_t place = f.color_begin[color] + team.rank(); place < end; place += team.size()) {
      const TileSlot slot(f.constraints, place);
      core::PatchConstraint c = load_bodies_and_points(slot);
      core::SolverBody a = load_moving(f.bodies[c.a]);
      core::SolverBody b = load_moving(f.bodies[c.b]);
      work(slot, c, a, b);
      store_velocity(f.bodies[c.a], a);
      store_velocity(f.bodies[c.b], b);
    }
    team.sync();
  }
}

__device__ inline void load_for_sweep(const TileSlot& slot, core::PatchConstraint& c) {
  load_tangents(slot, c);
  load_surface_and_masses(slot, c);
  load_impulses(slot, c);
}

template <typename Team>
__device__ void sweep(const Team& team, const RigidFrameView& f, bool pushes) {
  each_patch_by_color(team, f,
                      [&](const TileSlot& slot, core::PatchConstraint& c, core::SolverBody& a, core::SolverBody& b) {
                        load_for_sweep(slot, c);
                        core::solve_patch(c, a, b, f.soft, pushes);
                        store_impulses(slot, c);
                      });
}

template <typename Team>
__device__ void warm_start_all(const Team& team, const RigidFrameView& f) {
  each_patch_by_color(team, f,
                      [&](const TileSlot& slot, core::PatchConstraint& c, core::SolverBody& a, core::SolverBody& b) {
                        load_tangents(slot, c);
                        load_impulses(slot, c);
                        core::warm_start(c, a, b);
                        store_impulses(slot, c);
                      });
}

template <typename Team>
__device__ void bounce_all(const Team& team, const RigidFrameView& f) {
  each_patch_by_color(team, f,
                      [&](const TileSlot& slot, core::PatchConstraint& c, core::SolverBody& a, core::SolverBody& b) {
                        load_for_sweep(slot, c);
                        load_approach(slot, c);
                        if (!core::bounces(c, f.soft)) return;
                        core::bounce(c, a, b, f.soft);
                        store_impulses(slot, c);
                      });
}

template <typename Team>
__device__ void run_substep(const Team& team, const RigidFrameView& f, bool may_bounce) {
  if (may_bounce)
    each_patch(team, f, [&](const TileSlot& slot, core::PatchConstraint& c) {
      core::note_approach(c, load_moving(f.bodies[c.a]), load_moving(f.bodies[c.b]));
      store_approach(slot, c);
    });
  each_body(team, f, [&](std::uint32_t i) {
    core::SolverBody body = load_body(f.bodies[i]);
    core::accelerate(body, f.gravity_m_s2, f.wrench == nullptr ? nullptr : f.wrench + i, f.soft.dt_s);
    store_velocity(f.bodies[i], body);
  });
  warm_start_all(team, f);
  sweep(team, f, true);
  each_body(team, f, [&](std::uint32_t i) {
    core::SolverBody body = load_body(f.bodies[i]);
    core::move(body, f.mass[i], f.soft.dt_s);
    store_body(f.bodies[i], body);
  });
  for (std::uint32_t k = 0; k < f.relax_sweeps; ++k) sweep(team, f, false);
  if (may_bounce) bounce_all(team, f);
  each_patch(team, f, [&](const TileSlot& slot, core::PatchConstraint& c) {
    load_for_sweep(slot, c);
    load_approach(slot, c);
    load_totals(slot, c);
    core::add_to_totals(c, f.soft);
    store_impulses(slot, c);
    store_totals(slot, c);
  });
}

template <typename Team>
__device__ void run_substeps(const Team& team, const RigidFrameView& f) {
  const bool may_bounce = f.counts->bounces != 0;
  for (std::uint32_t k = 0; k < f.substeps; ++k) run_substep(team, f, may_bounce);
}

}  // namespace broadside::gpu

// The substeps of a step, with the sweeps of core/method/rigid/soft_contact.hpp: color by color, a thread a patch. The
// same loop as reference/octree_cpu/rigid/soft_solver.cpp.
#pragma once

#include "core/math/order_free_sum.hpp"
#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/constraint_stage.cuh"
#include "gpu/stages/rigid/constraint_tiles.cuh"
#include "gpu/stages/rigid/solver_bodies.cuh"
#include "gpu/stages/rigid/team_sums.cuh"

namespace broadside::gpu {

template <typename Team, typename Work>
__device__ void each_body(const Team& team, const RigidFrameView& f, const Work& work) {
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) work(static_cast<std::uint32_t>(i));
  team.sync();
}

// work(slot, constraint) for every patch, in any order: it reads bodies alone. No barrier behind it.
template <typename Team, typename Work>
__device__ void each_patch(const Team& team, const RigidFrameView& f, const Work& work) {
  for (std::uint64_t place = team.rank(); place < f.counts->places; place += team.size()) {
    if (f.patch_at[place] == kUncolored) continue;
    const TileSlot slot(f.constraints, place);
    core::PatchConstraint c = load_bodies_and_points(slot);
    work(slot, c);
  }
}

// work(slot, constraint, a, b) color by color; what it makes of the bodies' velocities is stored.
template <typename Team, typename Work>
__device__ void each_patch_by_color(const Team& team, const RigidFrameView& f, const Work& work) {
  const std::uint32_t colors = f.counts->colors;
  std::uint32_t begin = f.color_begin[0];
  std::uint32_t count = f.color_count[0];
  for (std::uint32_t color = 0; color < colors; ++color) {
    const std::uint64_t end = std::uint64_t{begin} + count;
    for (std::uint64_t place = begin + team.rank(); place < end; place += team.size()) {
      const TileSlot slot(f.constraints, place);
      core::PatchConstraint c = load_bodies_and_points(slot);
      core::SolverBody a = load_moving(f.bodies[c.a]);
      core::SolverBody b = load_moving(f.bodies[c.b]);
      work(slot, c, a, b);
      store_velocity(f.bodies[c.a], a);
      store_velocity(f.bodies[c.b], b);
    }
    // Before the barrier, which makes the threads forget what they loaded.
    if (color + 1 < colors) {
      begin = f.color_begin[color + 1];
      count = f.color_count[color + 1];
    }
    team.sync();
  }
}

__device__ inline void load_for_sweep(const TileSlot& slot, core::PatchConstraint& c) {
  load_tangents(slot, c);
  load_surface_and_masses(slot, c);
  load_impulses(slot, c);
}

// One step's numbers, and what its threads bring together.
struct Solve {
  core::SoftStep soft;
  bool may_bounce = false;
  TeamSums sums;
};

// Returns the largest change of a point's speed. has_way: directions follow.
template <typename Team>
__device__ float sweep(const Team& team, const RigidFrameView& f, Solve& solve, bool has_way) {
  float largest = 0.0F;
  each_patch_by_color(team, f,
                      [&](const TileSlot& slot, core::PatchConstraint& c, core::SolverBody& a, core::SolverBody& b) {
                        load_for_sweep(slot, c);
                        core::PatchWay way{};
                        core::note_impulses(c, way);
                        if (has_way) store_before(slot, c.count, way);
                        largest = fmaxf(largest, core::solve_patch(c, a, b, solve.soft));
                        store_impulses(slot, c);
                      });
  return has_way ? solve.sums.largest(team, largest) : largest;
}

// Adds to the impulses what the last directions suggest. Returns the square of what the last sweep changed.
template <typename Team>
__device__ float follow_direction(const Team& team, const RigidFrameView& f, Solve& solve, float last_change) {
  const auto changed = [&](const TileSlot& slot, core::PatchConstraint& c) {
    load_surface_and_masses(slot, c);
    load_impulses(slot, c);
    return core::squared_change(c, load_way(slot, c.count));
  };
  float largest = 0.0F;
  each_patch(team, f,
             [&](const TileSlot& slot, core::PatchConstraint& c) { largest = fmaxf(largest, changed(slot, c)); });
  const core::OrderFreeSum sum(solve.sums.largest(team, largest));
  std::uint64_t units = 0;
  each_patch(team, f, [&](const TileSlot& slot, core::PatchConstraint& c) { units += sum.units(changed(slot, c)); });
  const float change = sum.value(solve.sums.sum(team, units));
  const float share = last_change > 0.0F && change <= last_change ? change / last_change : 0.0F;
  each_patch_by_color(team, f,
                      [&](const TileSlot& slot, core::PatchConstraint& c, core::SolverBody& a, core::SolverBody& b) {
                        load_for_sweep(slot, c);
                        core::PatchWay way = load_way(slot, c.count);
                        core::follow(c, way, a, b, share);
                        store_impulses(slot, c);
                        store_direction(slot, c.count, way);
                      });
  return change;
}

template <typename Team>
__device__ void sweep_until_done(const Team& team, const RigidFrameView& f, Solve& solve) {
  const bool has_way = f.solver.sweeps > 1;
  float done = 0.0F;
  if (has_way) {
    float fastest = 0.0F;
    each_patch(team, f, [&](const TileSlot& slot, core::PatchConstraint& c) {
      fastest = fmaxf(fastest, core::fastest_point(c, load_moving(f.bodies[c.a]), load_moving(f.bodies[c.b])));
      store_direction(slot, c.count, core::PatchWay{});
    });
    // The speeds are read before anything changes them.
    done = f.solver.done * solve.sums.largest(team, fastest);
  }
  each_patch_by_color(team, f,
                      [&](const TileSlot& slot, core::PatchConstraint& c, core::SolverBody& a, core::SolverBody& b) {
                        load_tangents(slot, c);
                        load_impulses(slot, c);
                        core::warm_start(c, a, b);
                        store_impulses(slot, c);
                      });
  float last_change = 0.0F;
  for (std::uint32_t k = 1;; ++k) {
    const float largest = sweep(team, f, solve, has_way);
    if (k >= f.solver.sweeps || largest <= done) return;
    last_change = follow_direction(team, f, solve, last_change);
  }
}

// Returns the largest change of a point's speed.
template <typename Team>
__device__ float relax(const Team& team, const RigidFrameView& f, const Solve& solve) {
  float largest = 0.0F;
  each_patch_by_color(team, f,
                      [&](const TileSlot& slot, core::PatchConstraint& c, core::SolverBody& a, core::SolverBody& b) {
                        load_for_sweep(slot, c);
                        if (solve.may_bounce) load_approach(slot, c);
                        largest = fmaxf(largest, core::relax_patch(c, a, b, solve.soft));
                        store_impulses(slot, c);
                      });
  return largest;
}

// The fastest approach of what bounces. stops: what stopped each point is noted.
template <typename Team>
__device__ float fastest_of_bounces(const Team& team, const RigidFrameView& f, Solve& solve, bool stops) {
  float fastest = 0.0F;
  each_patch(team, f, [&](const TileSlot& slot, core::PatchConstraint& c) {
    load_surface_and_masses(slot, c);
    load_impulses(slot, c);
    load_approach(slot, c);
    fastest = fmaxf(fastest, core::fastest_bounce(c, solve.soft));
    if (!stops) return;
    core::note_stopping(c);
    store_stopping(slot, c);
  });
  return solve.sums.largest(team, fastest);
}

// Until nothing bounces any more that did.
template <typename Team>
__device__ void bounce_all(const Team& team, const RigidFrameView& f, Solve& solve) {
  float largest = fastest_of_bounces(team, f, solve, false);
  const float done = core::kBounceDone * largest;
  if (!(done > 0.0F)) return;
  // A share of what stopped them is given back, so that is to be known well.
  for (int k = 0; k < core::kMostBounceSweeps && largest > done; ++k)
    largest = solve.sums.largest(team, relax(team, f, solve));
  largest = fastest_of_bounces(team, f, solve, true);
  for (int k = 0; k < core::kMostBounceSweeps && largest > done; ++k) {
    float change = 0.0F;
    each_patch_by_color(team, f,
                        [&](const TileSlot& slot, core::PatchConstraint& c, core::SolverBody& a, core::SolverBody& b) {
                          load_for_sweep(slot, c);
                          load_approach(slot, c);
                          load_stopping(slot, c);
                          if (!(core::fastest_bounce(c, solve.soft) > 0.0F)) return;
                          change = fmaxf(change, core::bounce(c, a, b, solve.soft));
                          store_impulses(slot, c);
                        });
    largest = solve.sums.largest(team, change);
  }
}

template <typename Team>
__device__ void run_substep(const Team& team, const RigidFrameView& f, Solve& solve) {
  if (solve.may_bounce) {
    each_patch(team, f, [&](const TileSlot& slot, core::PatchConstraint& c) {
      core::note_approach(c, load_moving(f.bodies[c.a]), load_moving(f.bodies[c.b]));
      store_approach(slot, c);
    });
    team.sync();
  }
  each_body(team, f, [&](std::uint32_t i) {
    core::SolverBody body = load_body(f.bodies[i]);
    core::accelerate(body, f.gravity_m_s2, f.wrench == nullptr ? nullptr : f.wrench + i, solve.soft.dt_s);
    store_velocity(f.bodies[i], body);
  });
  sweep_until_done(team, f, solve);
  each_body(team, f, [&](std::uint32_t i) {
    core::SolverBody body = load_body(f.bodies[i]);
    core::move(body, f.mass[i], solve.soft.dt_s);
    store_body(f.bodies[i], body);
  });
  (void)relax(team, f, solve);
  if (solve.may_bounce) bounce_all(team, f, solve);
  each_patch(team, f, [&](const TileSlot& slot, core::PatchConstraint& c) {
    load_for_sweep(slot, c);
    load_approach(slot, c);
    load_totals(slot, c);
    core::add_to_totals(c, solve.soft);
    store_impulses(slot, c);
    store_totals(slot, c);
  });
  team.sync();
}

template <typename Team>
__device__ void run_substeps(const Team& team, const RigidFrameView& f) {
  const int kind = step_kind(f);
  Solve solve{f.soft[kind], f.counts->bounces != 0, TeamSums(f.counts)};
  for (std::uint32_t k = 0; k < f.substeps[kind]; ++k) run_substep(team, f, solve);
}

}  // namespace broadside::gpu

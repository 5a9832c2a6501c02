// The substeps of a step: the same loop as reference/octree_cpu/rigid/soft_solver.cpp. What the twin does to all
// contacts in loops of their own is done here where they are at hand already, with the same bits.
#pragma once

#include "core/math/order_free_sum.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/rigid/color_loop.cuh"
#include "gpu/stages/rigid/constraint_stage.cuh"
#include "gpu/stages/rigid/kept_impulses.cuh"
#include "gpu/stages/rigid/sweeps.cuh"
#include "gpu/stages/rigid/team_sums.cuh"

namespace broadside::gpu {

// One step's numbers, and what its threads bring together.
struct Solve {
  core::SoftStep soft;
  bool may_bounce = false;
  bool has_way = false;  // several sweeps along conjugate directions
  TeamSums sums;
  std::uint32_t sweep = 0;  // of all sweeps of bounces in this step
};

__device__ __forceinline__ void accelerate(const RigidFrameView& f, std::uint32_t i, core::SolverBody& body,
                                           float dt_s) {
  core::accelerate(body, f.gravity_m_s2, f.wrench == nullptr ? nullptr : f.wrench + i, dt_s);
}

// As the next substep's sweeps find it: the body that stands for the faces has no wrench and never moves.
__device__ __forceinline__ core::SolverBody accelerated(const RigidFrameView& f, std::uint32_t i, float dt_s) {
  core::SolverBody body = f.wrench == nullptr ? load_moving(f.bodies[i]) : load_body(f.bodies[i]);
  if (i < f.body_count) accelerate(f, i, body, dt_s);
  return body;
}

// Between two substeps, before the first and behind the last one: totals of the one that ends; of the one that begins,
// how fast points come. Brings their largest speed under gravity, which says when sweeps are done.
__device__ __forceinline__ void change_substeps(const SolveTeam& team, const RigidFrameView& f, const Solve& solve,
                                                bool ends, bool begins) {
  float fastest = 0.0F;
  each_place(team, f, [&](const TileSlot& slot, std::uint64_t /*place*/) {
    core::PatchConstraint c;
    load_bodies(slot, c);
    const core::Vec3 across = load_directions(slot, c);
    if (ends) {
      load_impulses(slot, c);
      if (solve.may_bounce) load_approach(slot, c);
      load_totals(slot, c);
      core::add_to_totals(c, solve.soft);
      if (solve.may_bounce) store_impulses(slot, c);
      store_totals(slot, c);
    }
    if (!begins || !(solve.may_bounce || solve.has_way)) return;
    load_arms(slot, across, c);
    if (solve.may_bounce) {
      core::note_approach(c, load_moving(f.bodies[c.a]), load_moving(f.bodies[c.b]));
      store_approach(slot, c);
    }
    if (!solve.has_way) return;
    const core::SolverBody a = accelerated(f, c.a, solve.soft.dt_s);
    const core::SolverBody b = accelerated(f, c.b, solve.soft.dt_s);
    fastest = fmaxf(fastest, core::fastest_point(c, a, b));
  });
  __syncwarp();
  if (begins && solve.has_way) solve.sums.bring_largest(TeamSums::kFirst, fastest);
}

// Behind a barrier.
__device__ __forceinline__ float largest_of_turn(const SolveTeam& team, Solve& solve) {
  const float largest = solve.sums.largest(TeamSums::kFirst);
  solve.sums.end_turn(team);
  return largest;
}

// The sum of what the last sweep changed, J. By all threads; a barrier.
__device__ __forceinline__ float sum_of_changes(const SolveTeam& team, const RigidFrameView& f, Solve& solve,
                                                float largest) {
  const core::OrderFreeSum sum(largest);
  std::uint64_t units = 0;
  for (std::uint64_t place = team.spread_rank(); place < f.counts->places; place += team.size())
    if (f.patch_at[place] != kUncolored) units += sum.units(f.changes[place]);
  __syncwarp();
  solve.sums.bring_sum(units);
  team.sync();
  const float change = sum.value(solve.sums.sum());
  solve.sums.end_turn(team);
  return change;
}

__device__ __forceinline__ void sweep_until_done(const SolveTeam& team, const RigidFrameView& f, Solve& solve,
                                                 float done) {
  float first_change = 0.0F;
  float last_change = 0.0F;
  float share = 0.0F;
  for (std::uint32_t k = 1;; ++k) {
    sweep_along(team, f, solve.soft, k == 1, share, solve.sums);
    team.sync();
    const float largest_change = solve.sums.largest(TeamSums::kSecond);
    const float largest_speed = largest_of_turn(team, solve);
    if (k >= f.solver.sweeps || largest_speed <= done) return;
    const float change = sum_of_changes(team, f, solve, largest_change);
    if (!(last_change > 0.0F)) first_change = change;
    share = core::share_of_direction(first_change, last_change, change);
    last_change = change;
    each_body(team, f, [&](std::uint32_t i) {
      core::SolverBody body = load_moving(f.bodies[i]);
      give_step_along(f, i, body, share);
      store_velocity(f.bodies[i], body);
    });
    team.sync();
  }
}

// The fastest approach of what bounces, whose bodies are stirred. A barrier.
__device__ __forceinline__ float stir_what_bounces(const SolveTeam& team, const RigidFrameView& f, Solve& solve) {
  float fastest = 0.0F;
  each_place(team, f, [&](const TileSlot& slot, std::uint64_t /*place*/) {
    core::PatchConstraint c;
    load_bodies(slot, c);
    load_directions(slot, c);
    load_impulses(slot, c);
    load_approach(slot, c);
    const float own = core::fastest_bounce(c, solve.soft);
    if (!(own > 0.0F)) return;
    fastest = fmaxf(fastest, own);
    stir(f, c.a, solve.sweep);
    stir(f, c.b, solve.sweep);
  });
  __syncwarp();
  solve.sums.bring_largest(TeamSums::kFirst, fastest);
  team.sync();
  return largest_of_turn(team, solve);
}

// The same as StepConstraints::bounce of the twin. Ends with a barrier.
__device__ __forceinline__ void bounce_all(const SolveTeam& team, const RigidFrameView& f, Solve& solve) {
  solve.sweep += 2;
  const float fastest = stir_what_bounces(team, f, solve);
  const float done = core::kBounceDone * fastest;
  if (!(done > 0.0F)) return;
  float largest = fastest;
  for (int k = 0; k < core::kMostBounceSweeps && largest > done; ++k, ++solve.sweep) {
    relax_stirred(team, f, solve.soft, solve.sweep, done, solve.sums);
    team.sync();
    largest = largest_of_turn(team, solve);
  }
  largest = fastest;
  for (int k = 0; k < core::kMostBounceSweeps && largest > done; ++k) {
    sweep_bouncing(team, f, solve.soft, k == 0, solve.sums);
    team.sync();
    largest = largest_of_turn(team, solve);
  }
}

// fastest: of the points as it begins, m/s; becomes that of the next substep.
__device__ __forceinline__ void run_substep(const SolveTeam& team, const RigidFrameView& f, Solve& solve, bool is_last,
                                            float& fastest) {
  each_body(team, f, [&](std::uint32_t i) {
    core::SolverBody body = load_body(f.bodies[i]);
    accelerate(f, i, body, solve.soft.dt_s);
    give_kept_impulses(f, i, body);
    store_velocity(f.bodies[i], body);
  });
  team.sync();
  if (solve.has_way) {
    sweep_until_done(team, f, solve, core::done_m_s(solve.soft, f.solver.done, fastest));
  } else {
    sweep_once(team, f, solve.soft);
    team.sync();
  }
  each_body(team, f, [&](std::uint32_t i) {
    core::SolverBody body = load_body(f.bodies[i]);
    core::move(body, f.mass[i], solve.soft.dt_s);
    store_body(f.bodies[i], body);
  });
  team.sync();
  relax_all(team, f, solve.soft, solve.may_bounce);
  team.sync();
  if (solve.may_bounce) bounce_all(team, f, solve);
  change_substeps(team, f, solve, true, !is_last);
  team.sync();
  if (!is_last && solve.has_way) fastest = largest_of_turn(team, solve);
}

__device__ __forceinline__ void run_substeps(const SolveTeam& team, const RigidFrameView& f) {
  const int kind = step_kind(f);
  Solve solve{f.soft[kind], f.counts->bounces != 0, f.solver.sweeps > 1, TeamSums(f.counts)};
  float fastest = 0.0F;
  if (solve.may_bounce || solve.has_way) {
    change_substeps(team, f, solve, false, true);
    team.sync();
    if (solve.has_way) fastest = largest_of_turn(team, solve);
  }
  for (std::uint32_t k = 0; k < f.substeps[kind]; ++k) run_substep(team, f, solve, k + 1 == f.substeps[kind], fastest);
}

}  // namespace broadside::gpu

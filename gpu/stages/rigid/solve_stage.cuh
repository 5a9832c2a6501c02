// The substeps of a step: the same loop as reference/octree_cpu/rigid/soft_solver.cpp. Some loops of the twin over all
// contacts are merged here into other loops that have loaded the contacts already, with the same bits.
#pragma once

#include "core/math/order_free_sum.hpp"
#include "core/method/rigid/kept_blows.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/rigid/bounce_sweeps.cuh"
#include "gpu/stages/rigid/color_loop.cuh"
#include "gpu/stages/rigid/constraint_stage.cuh"
#include "gpu/stages/rigid/kept_impulses.cuh"
#include "gpu/stages/rigid/pushed_patches.cuh"
#include "gpu/stages/rigid/sweeps.cuh"
#include "gpu/stages/rigid/team_sums.cuh"
#include "gpu/stages/rigid/versions.cuh"

namespace broadside::gpu {

// The numbers of one step, and the values to which its threads contribute.
struct Solve {
  core::SoftStep soft;
  bool may_bounce = false;
  bool forgets_blows = false;
  bool has_way = false;  // several sweeps along conjugate directions
  TeamSums sums;
  std::uint32_t sweep = 0;   // the present sweep over stirred bodies, counted over the step
  bool owes_totals = false;  // the impulses of the substep before are to be added to the totals
  SolveCounts done;

  // Whether more sweeps may follow the relaxation of all contacts.
  [[nodiscard]] __device__ bool may_stir() const { return may_bounce || core::may_begin(soft); }
};

// The largest first number of this turn, which ends here. Call after a barrier.
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

// Sweeps along conjugate directions until little changes. Call after a barrier; ends with one. Returns the fastest
// push.
__device__ __forceinline__ float sweep_until_done(const SolveTeam& team, const RigidFrameView& f, Solve& solve) {
  core::DirectionShare directions;
  float share = 0.0F;
  float done = 0.0F;
  float fastest_push = 0.0F;
  for (std::uint32_t k = 1;; ++k) {
    sweep_along(team, f, solve.soft, k == 1, solve.owes_totals, share, solve.sums);
    ++solve.done.sweeps;
    team.sync();
    if (k == 1) {
      const float fastest = solve.sums.largest(TeamSums::kThird);
      done = core::done_m_s(solve.soft, solve.soft.done_share, fastest);
      fastest_push = solve.sums.largest(TeamSums::kFourth);
      core::sweep_on_from(solve.soft, done, fastest_push > solve.soft.kept_push_m_s);
    }
    const float largest_change = solve.sums.largest(TeamSums::kSecond);
    const float largest_speed = largest_of_turn(team, solve);
    if (k >= solve.soft.most_sweeps || largest_speed <= done) return fastest_push;
    share = directions.after(sum_of_changes(team, f, solve, largest_change));
    each_body(team, f, [&](std::uint32_t i) {
      core::SolverBody body = load_moving(f, i);
      give_step_along(team, f, i, body, share, 0);
      store_velocity(f.bodies[i], body, team.version());
    });
    team.sync();
  }
}

// Why bodies are stirred.
enum class Stirred : std::uint8_t { kPushed, kBouncing };

// Sweeps over patches of stirred bodies until one sweep changes no point's speed by more than `done`. It is called at
// one place for both kinds, because its code is long and inlined.
__device__ __forceinline__ void relax_until_done(const SolveTeam& team, const RigidFrameView& f, Solve& solve,
                                                 Stirred of, float done) {
  const std::uint32_t most = of == Stirred::kPushed ? solve.soft.most_relax_sweeps : solve.soft.most_stop_sweeps;
  const std::uint32_t since = solve.sweep;
  core::DirectionShare directions;
  float share = 0.0F;
  for (std::uint32_t k = 1;; ++k) {
    relax_stirred(team, f, solve.soft, since, solve.sweep, done, share, solve.sums);
    ++solve.sweep;
    ++(of == Stirred::kPushed ? solve.done.sweeps : solve.done.bounce_sweeps);
    team.sync();
    const float largest_change = solve.sums.largest(TeamSums::kSecond);
    const float largest = largest_of_turn(team, solve);
    if (k >= most || !(largest > done)) return;
    if (!core::has_directions(solve.soft)) continue;
    share = directions.after(sum_of_changes(team, f, solve, largest_change));
    if (!(share > 0.0F)) continue;
    each_body(team, f, [&](std::uint32_t i) {
      if (f.relaxed[i] != since) return;
      core::SolverBody body = load_moving(f, i);
      give_step_along(team, f, i, body, share, since);
      store_velocity(f.bodies[i], body, team.version());
    });
    team.sync();
  }
}

// fastest: the fastest approach of points that bounce. The same as the second half of StepConstraints::bounce of the
// twin. Call after a barrier; ends with one.
__device__ __forceinline__ void bounce_all(const SolveTeam& team, const RigidFrameView& f, Solve& solve, float fastest,
                                           float done) {
  float largest = fastest;
  for (std::uint32_t k = 0; k < solve.soft.most_bounce_sweeps && largest > done; ++k) {
    sweep_bouncing(team, f, k == 0, done, solve.sums);
    ++solve.done.bounce_sweeps;
    team.sync();
    largest = largest_of_turn(team, solve);
  }
}

// The same as StepConstraints::relax_pushed and bounce of the twin. Call after a barrier; ends with one.
__device__ __forceinline__ void end_substep(const SolveTeam& team, const RigidFrameView& f, Solve& solve,
                                            bool is_pushed, float fastest_push) {
  std::uint32_t since = 0xFFFFFFFFU;  // no sweep is as late: no patch drops its impulses
  for (Stirred of = is_pushed ? Stirred::kPushed : Stirred::kBouncing;; of = Stirred::kBouncing) {
    float fastest = 0.0F;
    float done = 0.0F;
    if (of == Stirred::kPushed) {
      done = core::relax_done_m_s(solve.soft, fastest_push);
    } else {
      const float relaxed = solve.sums.largest(TeamSums::kSecond);  // the largest change that stirred bodies
      fastest = largest_of_turn(team, solve);
      if (!(fastest > 0.0F) && !(relaxed > solve.soft.begins_m_s)) return;
      done = core::kBounceDone * fastest;
      if (relaxed > 0.0F) done = fmaxf(done, solve.soft.stirring_m_s);
    }
    // If the bounce is so slow that its share rounds to 0, there are no sweeps.
    const bool has_sweeps = of == Stirred::kPushed || done > 0.0F;
    if (of == Stirred::kBouncing && has_sweeps && solve.forgets_blows) since = solve.sweep;
    if (has_sweeps) relax_until_done(team, f, solve, of, done);
    if (of == Stirred::kBouncing) {
      // Sweeps over what pushes left may also close points that approached fast.
      if (!(fastest > 0.0F) && !solve.may_bounce) return;
      if (has_sweeps) bounce_all(team, f, solve, fastest, done);
      break;
    }
    if (!solve.may_bounce) return;
    solve.sweep += 2;
    stir_what_bounces(team, f, solve.sweep, solve.sums);
    team.sync();
  }
  drop_all_impacts(team, f, since);
  team.sync();
}

// Stores the velocities that the substep's gravity and wrenches gave a body, if its contacts read them later.
__device__ __forceinline__ void note_start(const RigidFrameView& f, std::uint32_t i, const core::SolverBody& driven,
                                           const Solve& solve) {
  PackedStart& start = f.starts[i];
  if (!solve.has_way && !core::takes_back_pushes(solve.soft)) return;
  start.driven_v = {driven.v, 0.0F};
  start.driven_angular_momentum = {driven.angular_momentum, 0.0F};
}

// Sweeps over all contacts before the bodies move. Needs no barrier before it. Returns the fastest push.
__device__ __forceinline__ float sweep_all(const SolveTeam& team, const RigidFrameView& f, Solve& solve) {
  if (solve.has_way) {
    team.sync();
    return sweep_until_done(team, f, solve);
  }
  sweep_once(team, f, solve.soft, solve.owes_totals, solve.sums);
  ++solve.done.sweeps;
  if (!core::takes_back_pushes(solve.soft)) return 0.0F;
  team.sync();
  const float fastest_push = solve.sums.largest(TeamSums::kFourth);
  solve.sums.end_turn(team);
  return fastest_push;
}

// Loads a body's velocities. Returns whether its last patch has written them.
__device__ __forceinline__ bool try_last_velocity(const RigidFrameView& f, std::uint32_t i, std::uint32_t version,
                                                  core::SolverBody& body) {
  return try_velocity(f.bodies[i], version, body) || !core::is_moved(body) || f.memory.count[i] == 0;
}

// Gives all bodies gravity, wrenches and the impulses of the substep before.
__device__ __forceinline__ void begin_bodies(const SolveTeam& team, const RigidFrameView& f, const Solve& solve) {
  const std::uint32_t before = team.version();
  team.end_version();  // patches wait for the versions written below
  each_body_in_turn(
      team, f,
      [&](std::uint32_t i) {
        core::SolverBody body;
        body.inverse_mass = f.inverse_mass[i];
        body.orientation.q = f.bodies[i].q;
        return body;
      },
      [&](std::uint32_t i, core::SolverBody& body) { return try_last_velocity(f, i, before, body); },
      [&](std::uint32_t i, core::SolverBody& body) {
        core::accelerate(body, f.gravity_m_s2, f.wrench == nullptr ? nullptr : f.wrench + i, solve.soft.dt_s);
        note_start(f, i, body, solve);
        give_kept_impulses(team, f, i, body, team.kept_version());
        store_velocity(f.bodies[i], body, team.version());
      });
}

__device__ __forceinline__ void move_bodies(const SolveTeam& team, const RigidFrameView& f, const Solve& solve,
                                            bool is_pushed) {
  each_body_in_turn(
      team, f, [&](std::uint32_t i) { return load_moved(f, i); },
      [&](std::uint32_t i, core::SolverBody& body) { return try_last_velocity(f, i, team.version(), body); },
      [&](std::uint32_t i, core::SolverBody& body) {
        if (!core::is_moved(body)) return;
        core::move(body, f.mass[i], solve.soft.dt_s);
        if (is_pushed) {
          go_back_to_start(team, f, i, body);
          store_velocity(f.bodies[i], body, team.version());
        }
        store_moved(f, i, body, team.version());
      });
}

// Soft steps in which nothing bounces have no barrier: threads wait for versions instead.
__device__ __forceinline__ void run_substep(const SolveTeam& team, const RigidFrameView& f, Solve& solve) {
  begin_bodies(team, f, solve);
  const float fastest_push = sweep_all(team, f, solve);
  const bool is_pushed = fastest_push > solve.soft.kept_push_m_s;
  solve.sweep += 2;  // above the sweep for which the last one before stirred bodies
  if (is_pushed) {
    take_back_impulses(team, f, solve.sweep);
    team.sync();
  }
  move_bodies(team, f, solve, is_pushed);
  if (is_pushed) team.sync();
  relax_all(team, f, solve.soft, solve.may_stir() && !is_pushed, solve.sweep, solve.sums);
  solve.owes_totals = true;
  if (!is_pushed && !solve.may_stir()) return;
  team.sync();
  end_substep(team, f, solve, is_pushed, fastest_push);
}

// Ends with a barrier.
__device__ __forceinline__ void run_substeps(const SolveTeam& team, const RigidFrameView& f) {
  const int kind = step_kind(f);
  Solve solve{f.soft[kind],
              f.counts->bounces != 0,
              core::forgets_blows(static_cast<core::SolveKind>(kind)),
              f.solver.even.sweeps > 1,
              TeamSums(f.counts),
              0,
              false,
              {}};
  for (std::uint32_t k = 0; k < f.substeps[kind]; ++k) run_substep(team, f, solve);
  team.sync();
  if (team.rank() == 0) {
    f.counts->done = solve.done;
    f.counts->done.waits = team.waits();
  }
}

}  // namespace broadside::gpu

// One pass over all contacts, color by color, a thread a patch: the sweeps of core/method/rigid/soft_contact.hpp.
#pragma once

#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/rigid/color_loop.cuh"
#include "gpu/stages/rigid/team_sums.cuh"
#include "gpu/stages/rigid/versions.cuh"

namespace broadside::gpu {

// A patch, its bodies without their velocities, and what follows from both.
struct LoadedPatch {
  core::PatchConstraint c;
  core::SolverBody a;
  core::SolverBody b;
  core::PatchGoals goals;
  PatchOrder order;
};

// A patch with its impulses before the sweep and its last direction.
struct LoadedWay {
  LoadedPatch patch;
  core::PatchWay way;
};

// Loads a patch without its bodies' places.
__device__ __forceinline__ LoadedPatch load_unplaced(const TileSlot& slot) {
  LoadedPatch loaded;
  loaded.c = load_for_sweep(slot);
  loaded.order = load_order(slot, loaded.a, loaded.b);
  return loaded;
}
// Call after a barrier.
__device__ __forceinline__ LoadedPatch load_patch(const RigidFrameView& f, const TileSlot& slot) {
  LoadedPatch loaded = load_unplaced(slot);
  load_place(f.bodies[loaded.c.a], loaded.a);
  load_place(f.bodies[loaded.c.b], loaded.b);
  return loaded;
}
// Loads its bodies' places. Returns whether they are of this version, so that the bodies have been moved.
__device__ __forceinline__ bool try_places(const RigidFrameView& f, std::uint32_t version, LoadedPatch& p) {
  const bool has_a = try_place(f.bodies[p.c.a], version, p.a) || !core::is_moved(p.a);
  const bool has_b = try_place(f.bodies[p.c.b], version, p.b) || !core::is_moved(p.b);
  return has_a && has_b;
}
// Loads a patch with its bodies' places as they are. Needs no barrier, but its bodies must not be moved meanwhile.
__device__ __forceinline__ LoadedPatch load_patch_now(const RigidFrameView& f, const TileSlot& slot) {
  LoadedPatch loaded = load_unplaced(slot);
  (void)try_places(f, 0, loaded);
  return loaded;
}
// For sweeps that load the bodies' places with the patch.
struct IsPlaced {
  template <typename Loaded>
  __device__ bool operator()(const Loaded& /*loaded*/) const {
    return true;
  }
};

// Loads the velocities of a patch's bodies. Returns whether the patches before it have written them.
__device__ __forceinline__ bool try_velocities(const SolveTeam& team, const RigidFrameView& f, LoadedPatch& p) {
  const VelocityVersions of_a(team.version(), team.next_version(), p.order.of_a);
  const VelocityVersions of_b(team.version(), team.next_version(), p.order.of_b);
  const bool has_a = of_a.try_load(f.bodies[p.c.a], p.a);
  const bool has_b = of_b.try_load(f.bodies[p.c.b], p.b);
  return has_a && has_b;
}
// Stores the velocities for the patches after it.
__device__ __forceinline__ void give_velocities(const SolveTeam& team, const RigidFrameView& f, const LoadedPatch& p) {
  VelocityVersions(team.version(), team.next_version(), p.order.of_a).store(f.bodies[p.c.a], p.a);
  VelocityVersions(team.version(), team.next_version(), p.order.of_b).store(f.bodies[p.c.b], p.b);
}

// Prepares a patch for the first sweep of a substep: no point slides yet. owes_totals: the impulses of the substep
// before are still to be added to the totals. If the patch is pushed apart, its impulses before that are noted. Returns
// how fast it is pushed, m/s.
__device__ __forceinline__ float begin_substep(const TileSlot& slot, LoadedPatch& loaded, const core::SoftStep& soft,
                                               bool owes_totals) {
  core::PatchConstraint& c = loaded.c;
  core::forget_slips(c);
  float push = 0.0F;
  if (core::takes_back_pushes(soft)) {
    push = core::fastest_push(c, soft, core::gaps_now(c, loaded.a, loaded.b));
    store_before_push(slot, c, core::is_taken_back(push, soft));
  }
  if (!owes_totals) return push;
  load_totals(slot, c);
  core::add_to_totals(c);
  store_totals(slot, c);
  return push;
}

// A substep's only sweep. Contributes the fastest push.
__device__ __forceinline__ void sweep_once(const SolveTeam& team, const RigidFrameView& f, const core::SoftStep& soft,
                                           bool owes_totals, const TeamSums& sums) {
  float fastest_push = 0.0F;
  each_place_in_turn(
      team, f, [&](const TileSlot& slot) { return load_patch_now(f, slot); }, IsPlaced{},
      [&](const TileSlot& slot, LoadedPatch& p) {
        fastest_push = fmaxf(fastest_push, begin_substep(slot, p, soft, owes_totals));
        p.goals = core::goals_of(p.c, p.a, p.b, soft);
      },
      [&](LoadedPatch& p) { return try_velocities(team, f, p); },
      [&](const TileSlot& /*slot*/, std::uint64_t /*place*/, LoadedPatch& p) {
        (void)core::solve_patch(p.c, p.goals, p.a, p.b, soft);
        give_velocities(team, f, p);
      },
      [](const TileSlot& slot, std::uint64_t /*place*/, const LoadedPatch& p) { store_impulses(slot, p.c); });
  __syncwarp();
  if (core::takes_back_pushes(soft)) sums.bring_largest(TeamSums::kFourth, fastest_push);
}

// The motion of the patch's bodies after the substep's gravity and wrenches, before any impulse.
__device__ __forceinline__ core::PatchMotion driven_motion(const RigidFrameView& f, const LoadedPatch& p) {
  const PackedStart& a = f.starts[p.c.a];
  const PackedStart& b = f.starts[p.c.b];
  return core::motion_of<float>(p.c, a.driven_v.v,
                                core::fused_product(p.a.inverse_inertia, a.driven_angular_momentum.v), b.driven_v.v,
                                core::fused_product(p.b.inverse_inertia, b.driven_angular_momentum.v));
}

// One of several sweeps along conjugate directions. Except in the first sweep, a patch's impulses first follow the last
// direction by `share`; give_step_along has applied that step to the bodies already. Contributes the largest change of
// a point's speed, the largest of f.changes and, in the first sweep, the largest speed of a point before any impulse
// and the fastest push.
__device__ __forceinline__ void sweep_along(const SolveTeam& team, const RigidFrameView& f, const core::SoftStep& soft,
                                            bool is_first, bool owes_totals, float share, const TeamSums& sums) {
  float largest_speed = 0.0F;
  float largest_change = 0.0F;
  float fastest = 0.0F;
  float fastest_push = 0.0F;
  each_place_in_turn(
      team, f,
      [&](const TileSlot& slot) {
        return LoadedWay{load_patch(f, slot), {}};
      },
      IsPlaced{},
      [&](const TileSlot& slot, LoadedWay& loaded) {
        core::PatchConstraint& c = loaded.patch.c;
        if (is_first) {
          fastest_push = fmaxf(fastest_push, begin_substep(slot, loaded.patch, soft, owes_totals));
          fastest = fmaxf(fastest, core::fastest_point(c, driven_motion(f, loaded.patch)));
        } else {
          load_triples(slot, kBefore, loaded.way.before);
          load_triples(slot, kWays, loaded.way.way);
          core::follow_impulses(c, loaded.way, share);
        }
        core::note_impulses(c, loaded.way);
        store_triples(slot, kBefore, loaded.way.before);
        store_triples(slot, kWays, loaded.way.way);
        loaded.patch.goals = core::goals_of(c, loaded.patch.a, loaded.patch.b, soft);
      },
      [&](LoadedWay& loaded) { return try_velocities(team, f, loaded.patch); },
      [&](const TileSlot& /*slot*/, std::uint64_t /*place*/, LoadedWay& loaded) {
        LoadedPatch& p = loaded.patch;
        largest_speed = fmaxf(largest_speed, core::solve_patch(p.c, p.goals, p.a, p.b, soft));
        give_velocities(team, f, p);
      },
      [&](const TileSlot& slot, std::uint64_t place, const LoadedWay& loaded) {
        store_impulses(slot, loaded.patch.c);
        const float change = core::squared_change(loaded.patch.c, loaded.way);
        largest_change = fmaxf(largest_change, change);
        f.changes[place] = change;
      });
  __syncwarp();
  sums.bring_largest(TeamSums::kFirst, largest_speed);
  sums.bring_largest(TeamSums::kSecond, largest_change);
  if (!is_first) return;
  sums.bring_largest(TeamSums::kThird, fastest);
  if (core::takes_back_pushes(soft)) sums.bring_largest(TeamSums::kFourth, fastest_push);
}

// Marks a body whose patches sweep `sweep` has to visit. Bodies that never move are not marked.
__device__ __forceinline__ void stir(const RigidFrameView& f, std::uint32_t body, std::uint32_t sweep) {
  if (body < f.body_count && f.mass[body].inverse_mass > 0.0F) f.stirred[body] = sweep;
}

// Sets the goals of a patch after the bodies moved, and its masses where they have turned far.
__device__ __forceinline__ void set_goals_after_motion(const TileSlot& slot, const core::SoftStep& soft,
                                                       LoadedPatch& p) {
  const bool sets_masses = core::has_turned_far(p.a) || core::has_turned_far(p.b);
  p.goals = core::goals_after_motion(p.c, p.a, p.b, soft);
  if (!sets_masses) return;
  store_masses(slot, p.c);
  store_mobility(slot, p.c);
}

// Relaxes each contact once; the last bodies may still be moving meanwhile. stirs: a patch that bounces, or that
// changes by more than soft.stirring_m_s, stirs its bodies for sweep `sweep`; the fastest approach of a bounce and the
// largest such change are contributed.
__device__ __forceinline__ void relax_all(const SolveTeam& team, const RigidFrameView& f, const core::SoftStep& soft,
                                          bool stirs, std::uint32_t sweep, const TeamSums& sums) {
  float fastest = 0.0F;
  float largest = 0.0F;
  float change = 0.0F;  // of the patch that is kept next
  team.begin_keeping();
  const std::uint32_t version = team.version();
  each_place_in_turn(
      team, f,
      [&](const TileSlot& slot) {
        LoadedPatch loaded = load_unplaced(slot);
        load_impact(slot, loaded.c);
        return loaded;
      },
      [&](LoadedPatch& p) { return try_places(f, version, p); },
      [&](const TileSlot& slot, LoadedPatch& p) { set_goals_after_motion(slot, soft, p); },
      [&](LoadedPatch& p) { return try_velocities(team, f, p); },
      [&](const TileSlot& /*slot*/, std::uint64_t /*place*/, LoadedPatch& p) {
        change = core::relax_patch(p.c, p.goals, p.a, p.b);
        give_velocities(team, f, p);
      },
      [&](const TileSlot& slot, std::uint64_t /*place*/, const LoadedPatch& p) {
        store_kept_impulses(slot, p.c, team.kept_version());
        if (!stirs) return;
        const float own = p.c.surface.restitution > 0.0F ? core::fastest_bounce(p.c) : 0.0F;
        const bool is_pushed = change > soft.stirring_m_s;
        if (!(own > 0.0F) && !is_pushed) return;
        fastest = fmaxf(fastest, own);
        if (is_pushed) largest = fmaxf(largest, change);
        stir(f, p.c.a, sweep);
        stir(f, p.c.b, sweep);
      });
  __syncwarp();
  if (!stirs) return;
  sums.bring_largest(TeamSums::kFirst, fastest);
  sums.bring_largest(TeamSums::kSecond, largest);
}

}  // namespace broadside::gpu

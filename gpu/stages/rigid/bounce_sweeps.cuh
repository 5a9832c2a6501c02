// The sweeps over contacts that bounce: core/method/rigid/soft_contact.hpp.
#pragma once

#include "core/method/rigid/kept_blows.hpp"
#include "gpu/stages/rigid/sweeps.cuh"

namespace broadside::gpu {

// A patch that bounces, and its bodies without their velocities.
struct LoadedBounce {
  core::PatchConstraint c;
  core::SolverBody a;
  core::SolverBody b;
  bool bounces = false;
};

// A patch for a sweep over stirred bodies. is_whole: it is known to be visited, so all of it is loaded; otherwise only
// the indices of its bodies are.
struct LoadedStirred {
  LoadedWay of;
  bool is_whole = false;
};

__device__ __forceinline__ void note_relaxed(const RigidFrameView& f, std::uint32_t body, std::uint32_t since) {
  if (body < f.body_count) f.relaxed[body] = since;
}

// Relaxes the contacts of stirred bodies again. With conjugate directions it also visits the patches that this
// relaxation has visited already, whose first sweep is `since`: their impulses first follow their last direction by
// `share`. A patch that changes by more than `done` stirs its bodies for the next sweep. Contributes the largest change
// of a point's speed and, with directions, the largest of f.changes.
__device__ __forceinline__ void relax_stirred(const SolveTeam& team, const RigidFrameView& f,
                                              const core::SoftStep& soft, std::uint32_t since, std::uint32_t sweep,
                                              float done, float share, const TeamSums& sums) {
  const bool has_directions = core::has_directions(soft);
  float largest = 0.0F;
  float largest_change = 0.0F;
  const auto is_stirred = [&](const core::PatchConstraint& c) {
    return f.stirred[c.a] >= sweep || f.stirred[c.b] >= sweep;
  };
  each_visited_by_color(
      team,
      [&](const TileSlot& slot) {
        LoadedStirred loaded;
        LoadedPatch& p = loaded.of.patch;
        load_bodies(slot, p.c);
        const bool follows = has_directions && load_relaxed(slot) == since;
        loaded.is_whole = follows || is_stirred(p.c);
        if (!loaded.is_whole) return loaded;
        p = load_patch(f, slot);
        load_impact(slot, p.c);
        if (has_directions) {
          core::PatchWay& way = loaded.of.way;
          if (follows) {
            load_triples(slot, kBefore, way.before);
            load_triples(slot, kWays, way.way);
            core::follow_impulses(p.c, way, share);
          } else {
            way = {};
            store_relaxed(slot, since);
            note_relaxed(f, p.c.a, since);
            note_relaxed(f, p.c.b, since);
          }
          core::note_impulses(p.c, way);
          store_triples(slot, kBefore, way.before);
          store_triples(slot, kWays, way.way);
        }
        set_goals_after_motion(slot, soft, p);
        return loaded;
      },
      [&](const TileSlot& slot, std::uint32_t place, LoadedStirred& loaded) {
        LoadedPatch& p = loaded.of.patch;
        if (!loaded.is_whole) {
          if (has_directions) f.changes[place] = 0.0F;
          return;
        }
        float change = 0.0F;
        with_velocities(team, f, p.c, p.a, p.b, [&] { change = core::relax_patch(p.c, p.goals, p.a, p.b); });
        store_kept_impulses(slot, p.c, team.kept_version());
        if (has_directions) {
          const float squared = core::squared_change(p.c, loaded.of.way);
          largest_change = fmaxf(largest_change, squared);
          f.changes[place] = squared;
        }
        largest = fmaxf(largest, change);
        if (!(change > done)) return;
        stir(f, p.c.a, sweep + 1);
        stir(f, p.c.b, sweep + 1);
      },
      KeepsNothing{},
      Visits{true,
             [&](const TileSlot& slot) {
               core::PatchConstraint c;
               load_bodies(slot, c);
               const bool follows = has_directions && load_relaxed(slot) == since;
               return follows | (f.stirred[c.a] >= sweep) | (f.stirred[c.b] >= sweep);
             },
             [&](std::uint32_t place) {
               if (has_directions) f.changes[place] = 0.0F;
             },
             // An earlier color of this sweep may have stirred the patch's bodies since it was loaded.
             [&](const LoadedStirred& loaded) { return !loaded.is_whole && is_stirred(loaded.of.patch.c); }});
  __syncwarp();
  sums.bring_largest(TeamSums::kFirst, largest);
  if (has_directions) sums.bring_largest(TeamSums::kSecond, largest_change);
}

// Gives points that approached fast their speed of rebound. is_first: notes which patches bounce, and how much impulse
// each of them may give. Later sweeps change the impulses of these patches only, so no other patch starts to bounce.
// Contributes the largest change of a point's speed.
__device__ __forceinline__ void sweep_bouncing(const SolveTeam& team, const RigidFrameView& f, bool is_first,
                                               float done, const TeamSums& sums) {
  float largest = 0.0F;
  each_visited_by_color(
      team,
      [&](const TileSlot& slot) {
        LoadedBounce loaded;
        core::PatchConstraint& c = loaded.c;
        if (!is_first) {
          c.budget_n_s = load_budget(slot);
          if (c.budget_n_s == kBouncesNot) return loaded;
        }
        load_bodies(slot, c);
        const core::Vec3 across = load_directions(slot, c);
        load_impulses(slot, c);
        load_impact(slot, c);
        loaded.bounces = core::fastest_bounce(c) > 0.0F;
        if (!loaded.bounces) {
          store_budget(slot, kBouncesNot);
          return loaded;
        }
        load_levers(slot, c);
        load_masses(slot, c);
        load_mobility(slot, across, c);
        if (is_first) core::note_budget(c);
        load_place(f.bodies[c.a], loaded.a);
        load_place(f.bodies[c.b], loaded.b);
        (void)load_order(slot, loaded.a, loaded.b);
        return loaded;
      },
      [&](const TileSlot& /*slot*/, std::uint32_t /*place*/, LoadedBounce& loaded) {
        if (!loaded.bounces) return;
        with_velocities(team, f, loaded.c, loaded.a, loaded.b,
                        [&] { largest = fmaxf(largest, core::bounce(loaded.c, loaded.a, loaded.b, done)); });
      },
      [&team](const TileSlot& slot, std::uint32_t /*place*/, const LoadedBounce& loaded) {
        if (!loaded.bounces) return;
        store_kept_impulses(slot, loaded.c, team.kept_version());
        store_budget(slot, loaded.c.budget_n_s);
      },
      Visits{!is_first, [](const TileSlot& slot) { return load_budget(slot) != kBouncesNot; },
             [](std::uint32_t /*place*/) {}, NeverStale{}});
  __syncwarp();
  sums.bring_largest(TeamSums::kFirst, largest);
}

// Ends a substep with impacts: core::drop_impulses for patches of bodies that were stirred for sweep `since` or a later
// one, core::drop_impacts for all others. The impulses that are left are added to the totals later, with those of all
// patches (begin_substep).
__device__ __forceinline__ void drop_all_impacts(const SolveTeam& team, const RigidFrameView& f, std::uint32_t since) {
  each_place(team, f, [&](const TileSlot& slot, std::uint64_t /*place*/) {
    core::PatchConstraint c;
    load_directions(slot, c);
    load_bodies(slot, c);
    const bool is_struck = f.stirred[c.a] >= since || f.stirred[c.b] >= since;
    if (!is_struck && !(c.surface.restitution > 0.0F)) return;
    load_impulses(slot, c);
    if (is_struck) {
      load_totals(slot, c);
      core::drop_impulses(c);
    } else {
      load_impact(slot, c);
      core::drop_impacts(c);
    }
    load_levers(slot, c);
    store_totals(slot, c);
    store_kept_impulses(slot, c, team.kept_version());
  });
}

}  // namespace broadside::gpu

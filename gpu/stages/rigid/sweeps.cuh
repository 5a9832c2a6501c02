// One pass over all contacts, color by color, a thread a patch: the sweeps of core/method/rigid/soft_contact.hpp.
#pragma once

#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/rigid/color_loop.cuh"
#include "gpu/stages/rigid/team_sums.cuh"

namespace broadside::gpu {

struct LoadedPatch {
  core::PatchConstraint c;
};

// A patch and its impulses before the sweep.
struct LoadedWay {
  core::PatchConstraint c;
  core::PatchWay way;
};

// A substep's only sweep. Nothing slides yet.
__device__ __forceinline__ void sweep_once(const SolveTeam& team, const RigidFrameView& f, const core::SoftStep& soft) {
  each_place_by_color(
      team, f,
      [](const TileSlot& slot) {
        LoadedPatch loaded{load_for_sweep(slot)};
        core::each_point(loaded.c, [&](int k) { loaded.c.points[k].slides = false; });
        return loaded;
      },
      [&](const TileSlot& slot, std::uint64_t /*place*/, LoadedPatch& loaded) {
        with_bodies(f, loaded.c,
                    [&](core::SolverBody& a, core::SolverBody& b) { (void)core::solve_patch(loaded.c, a, b, soft); });
        store_impulses(slot, loaded.c);
      });
}

// A sweep of several along conjugate directions. The impulses follow the last direction by `share` before, except in
// the first sweep; what that does to the bodies was done by give_step_along. Brings the largest change of a point's
// speed, and that of f.changes.
__device__ __forceinline__ void sweep_along(const SolveTeam& team, const RigidFrameView& f, const core::SoftStep& soft,
                                            bool is_first, float share, const TeamSums& sums) {
  float largest_speed = 0.0F;
  float largest_change = 0.0F;
  each_place_by_color(
      team, f,
      [&](const TileSlot& slot) {
        LoadedWay loaded{load_for_sweep(slot), {}};
        if (is_first) {
          core::each_point(loaded.c, [&](int k) { loaded.c.points[k].slides = false; });
        } else {
          load_triples(slot, kBefore, loaded.way.before);
          load_triples(slot, kWays, loaded.way.way);
          core::follow_impulses(loaded.c, loaded.way, share);
        }
        core::note_impulses(loaded.c, loaded.way);
        store_triples(slot, kBefore, loaded.way.before);
        store_triples(slot, kWays, loaded.way.way);
        return loaded;
      },
      [&](const TileSlot& slot, std::uint64_t place, LoadedWay& loaded) {
        with_bodies(f, loaded.c, [&](core::SolverBody& a, core::SolverBody& b) {
          largest_speed = fmaxf(largest_speed, core::solve_patch(loaded.c, a, b, soft));
        });
        store_impulses(slot, loaded.c);
        const float change = core::squared_change(loaded.c, loaded.way);
        largest_change = fmaxf(largest_change, change);
        f.changes[place] = change;
      });
  __syncwarp();
  sums.bring_largest(TeamSums::kFirst, largest_speed);
  sums.bring_largest(TeamSums::kSecond, largest_change);
}

// Each contact once, after the bodies moved.
__device__ __forceinline__ void relax_all(const SolveTeam& team, const RigidFrameView& f, const core::SoftStep& soft,
                                          bool may_bounce) {
  each_place_by_color(
      team, f,
      [&](const TileSlot& slot) {
        LoadedPatch loaded{load_for_sweep(slot)};
        if (may_bounce) load_approach(slot, loaded.c);
        return loaded;
      },
      [&](const TileSlot& slot, std::uint64_t /*place*/, LoadedPatch& loaded) {
        with_bodies(f, loaded.c, [&](core::SolverBody& a, core::SolverBody& b) {
          (void)core::relax_patch(loaded.c, a, b, soft);
          if (core::has_turned_far(a) || core::has_turned_far(b)) store_masses(slot, loaded.c);
        });
        store_impulses(slot, loaded.c);
      });
}

// Bodies whose patches the sweep has to visit. Those that never move are not stirred.
__device__ __forceinline__ void stir(const RigidFrameView& f, std::uint32_t body, std::uint32_t sweep) {
  if (body < f.body_count && f.mass[body].inverse_mass > 0.0F) f.stirred[body] = sweep;
}

// Again, the contacts of bodies that are stirred. What changes by more than `done` stirs its bodies for the next sweep.
// Brings the largest change of a point's speed.
__device__ __forceinline__ void relax_stirred(const SolveTeam& team, const RigidFrameView& f,
                                              const core::SoftStep& soft, std::uint32_t sweep, float done,
                                              const TeamSums& sums) {
  float largest = 0.0F;
  each_place_by_color(
      team, f,
      [](const TileSlot& slot) {
        LoadedPatch loaded;
        load_bodies(slot, loaded.c);
        return loaded;
      },
      [&](const TileSlot& slot, std::uint64_t /*place*/, LoadedPatch& loaded) {
        if (f.stirred[loaded.c.a] < sweep && f.stirred[loaded.c.b] < sweep) return;
        core::PatchConstraint c = load_for_sweep(slot);
        load_approach(slot, c);
        float change = 0.0F;
        with_bodies(f, c, [&](core::SolverBody& a, core::SolverBody& b) { change = core::relax_patch(c, a, b, soft); });
        store_impulses(slot, c);
        largest = fmaxf(largest, change);
        if (!(change > done)) return;
        stir(f, c.a, sweep + 1);
        stir(f, c.b, sweep + 1);
      });
  __syncwarp();
  sums.bring_largest(TeamSums::kFirst, largest);
}

// What came fast leaves. is_first: what stopped each point is noted. Brings the largest change of a point's speed.
__device__ __forceinline__ void sweep_bouncing(const SolveTeam& team, const RigidFrameView& f,
                                               const core::SoftStep& soft, bool is_first, const TeamSums& sums) {
  float largest = 0.0F;
  each_place_by_color(
      team, f,
      [&](const TileSlot& slot) {
        LoadedPatch loaded;
        load_bodies(slot, loaded.c);
        load_directions(slot, loaded.c);
        load_impulses(slot, loaded.c);
        load_approach(slot, loaded.c);
        return loaded;
      },
      [&](const TileSlot& slot, std::uint64_t /*place*/, LoadedPatch& loaded) {
        core::PatchConstraint& c = loaded.c;
        if (!(core::fastest_bounce(c, soft) > 0.0F)) return;
        load_arms(slot, load_directions(slot, c), c);
        load_masses(slot, c);
        if (is_first) {
          core::note_stopping(c);
          store_stopping(slot, c);
        } else {
          load_stopping(slot, c);
        }
        with_bodies(f, c, [&](core::SolverBody& a, core::SolverBody& b) {
          largest = fmaxf(largest, core::bounce(c, a, b, soft));
        });
        store_impulses(slot, c);
      });
  __syncwarp();
  sums.bring_largest(TeamSums::kFirst, largest);
}

}  // namespace broadside::gpu

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

// A substep's only sweep. begins: nothing slides yet.
__device__ __forceinline__ void sweep_once(const SolveTeam& team, const RigidFrameView& f, const core::SoftStep& soft) {
  each_place_by_color(
      team, f,
      [](const TileSlot& slot) {
        LoadedPatch loaded{load_for_sweep(slot)};
        core::each_point(loaded.c, [&](int k) { loaded.c.points[k].slides = false; });
        return loaded;
      },
      [&](const TileSlot& slot, std::uint64_t /*place*/, LoadedPatch& loaded, core::SolverBody& a,
          core::SolverBody& b) {
        (void)core::solve_patch(loaded.c, a, b, soft);
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
      [&](const TileSlot& slot, std::uint64_t place, LoadedWay& loaded, core::SolverBody& a, core::SolverBody& b) {
        largest_speed = fmaxf(largest_speed, core::solve_patch(loaded.c, a, b, soft));
        store_impulses(slot, loaded.c);
        const float change = core::squared_change(loaded.c, loaded.way);
        largest_change = fmaxf(largest_change, change);
        f.changes[place] = change;
      });
  __syncwarp();
  sums.bring_largest(TeamSums::kFirst, largest_speed);
  sums.bring_largest(TeamSums::kSecond, largest_change);
}

// Brings the largest change of a point's speed.
__device__ __forceinline__ void sweep_relaxing(const SolveTeam& team, const RigidFrameView& f,
                                               const core::SoftStep& soft, bool may_bounce, const TeamSums& sums) {
  float largest = 0.0F;
  each_place_by_color(
      team, f,
      [&](const TileSlot& slot) {
        LoadedPatch loaded{load_for_sweep(slot)};
        if (may_bounce) load_approach(slot, loaded.c);
        return loaded;
      },
      [&](const TileSlot& slot, std::uint64_t /*place*/, LoadedPatch& loaded, core::SolverBody& a,
          core::SolverBody& b) {
        const float change = core::relax_patch(loaded.c, a, b, soft);
        if (may_bounce) largest = fmaxf(largest, change);
        store_impulses(slot, loaded.c);
      });
  __syncwarp();
  if (may_bounce) sums.bring_largest(TeamSums::kFirst, largest);
}

// The same, of what bounces.
__device__ __forceinline__ void sweep_bouncing(const SolveTeam& team, const RigidFrameView& f,
                                               const core::SoftStep& soft, const TeamSums& sums) {
  float largest = 0.0F;
  each_place_by_color(
      team, f,
      [&](const TileSlot& slot) {
        LoadedPatch loaded{load_for_sweep(slot)};
        load_approach(slot, loaded.c);
        load_stopping(slot, loaded.c);
        return loaded;
      },
      [&](const TileSlot& slot, std::uint64_t /*place*/, LoadedPatch& loaded, core::SolverBody& a,
          core::SolverBody& b) {
        if (!(core::fastest_bounce(loaded.c, soft) > 0.0F)) return;
        largest = fmaxf(largest, core::bounce(loaded.c, a, b, soft));
        store_impulses(slot, loaded.c);
      });
  __syncwarp();
  sums.bring_largest(TeamSums::kFirst, largest);
}

}  // namespace broadside::gpu

// Applies impulses that are known beforehand to the bodies. Each body has a thread, which goes through the body's
// patches in the order of their colors, without a barrier. The bits are those of a sweep color by color, because such
// impulses do not depend on velocities and no two patches of a body have one color.
#pragma once

#include <utility>

#include "core/method/rigid/conjugate_directions.hpp"
#include "core/method/rigid/soft_contact.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/rigid/constraint_tiles.cuh"
#include "gpu/stages/rigid/solve_team.cuh"

namespace broadside::gpu {

// A patch as the thread of one of its bodies loads it; `loaded` is what the caller's load returned.
template <typename Loaded>
struct KnownPatch {
  core::PatchConstraint c;
  Loaded loaded;
  bool is_b = false;  // the body is the patch's B
};

struct NothingMore {};

// load(slot, patch) loads what push(patch, loaded) needs to compute the core::WorldPush of the patch. Centers are
// loaded here.
template <typename Load, typename Push>
__device__ __forceinline__ void give_known_impulses(const SolveTeam& team, const RigidFrameView& f, std::uint32_t i,
                                                    core::SolverBody& body, const Load& load, const Push& push) {
  using Known = KnownPatch<decltype(load(TileSlot(), std::declval<core::PatchConstraint&>()))>;
  const std::uint32_t* places = f.by_color + f.memory.begin[i];
  const std::uint32_t count = core::is_moved(body) ? f.memory.count[i] : 0;  // a sleeping body is not moved
  const auto load_known = [&](std::uint32_t place_and_side) {
    const TileSlot slot = team.slot(place_and_side / 2);
    Known known;
    known.is_b = place_and_side % 2 != 0;
    known.loaded = load(slot, known.c);
    load_centers(slot, slot.at(kAcross).v, known.c);
    return known;
  };
  // A patch is loaded one round before it is used, and its place one round before that.
  Known ahead;
  std::uint32_t next = count > 0 ? places[0] : 0;
  for (std::uint32_t k = 0; k <= count; ++k) {
    const Known now = ahead;
    if (k < count) ahead = load_known(next);
    next = k + 1 < count ? places[k + 1] : 0;
    if (k == 0) continue;
    const core::WorldPushOf<float> given = push(now.c, now.loaded);
    if (now.is_b)
      core::give_to_b(now.c, given, body);
    else
      core::give_to_a(now.c, given, body);
  }
}

// Applies the impulses of the substep before, which have this version: core::warm_start. They are mostly there already,
// so lanes do not wait together (wait_until).
__device__ __forceinline__ void give_kept_impulses(const SolveTeam& team, const RigidFrameView& f, std::uint32_t i,
                                                   core::SolverBody& body, std::uint32_t version) {
  struct Known {
    TileSlot slot;
    LoadedGiven given;
  };
  give_known_impulses(
      team, f, i, body,
      [](const TileSlot& slot, core::PatchConstraint& /*c*/) {
        return Known{slot, load_given(slot)};
      },
      [version](const core::PatchConstraint& /*c*/, Known known) {
        for (; !known.given.is_of(version); known.given = load_given(known.slot)) relax();
        return core::WorldPushOf<float>{known.given.impulse.v, known.given.moment.v};
      });
}

// Applies the impulses as they are now, after sweeps that did not store their sum (store_given).
__device__ __forceinline__ void give_present_impulses(const SolveTeam& team, const RigidFrameView& f, std::uint32_t i,
                                                      core::SolverBody& body) {
  give_known_impulses(
      team, f, i, body,
      [](const TileSlot& slot, core::PatchConstraint& c) {
        load_bodies(slot, c);
        load_directions(slot, c);
        load_levers(slot, c);
        load_impulses(slot, c);
        return NothingMore{};
      },
      [](const core::PatchConstraint& c, NothingMore /*none*/) { return core::whole_push(c); });
}

// The last direction of each point: core::PatchWay::way.
struct KnownWays {
  float of[kFourPoints][3] = {};
};

// Applies a step along the last directions: core::push_along. since: the first sweep of a relaxation, only whose
// patches take part; 0 = all patches, before the bodies move.
__device__ __forceinline__ void give_step_along(const SolveTeam& team, const RigidFrameView& f, std::uint32_t i,
                                                core::SolverBody& body, float share, std::uint32_t since) {
  give_known_impulses(
      team, f, i, body,
      [since](const TileSlot& slot, core::PatchConstraint& c) {
        load_bodies(slot, c);
        load_directions(slot, c);
        load_levers(slot, c);
        KnownWays ways;
        if (since == 0 || load_relaxed(slot) == since) load_triples(slot, kWays, ways.of);
        return ways;
      },
      [share](const core::PatchConstraint& c, const KnownWays& ways) {
        core::PatchPushOf<float> along;
        core::each_point(c, [&](int k) {
          const core::PointStep step = core::step_along(ways.of[k], share);
          along.add_normal(c.points[k].lever, step.normal);
          along.add_tangents(c.points[k].lever, step.tangent_1, step.tangent_2);
        });
        return core::in_world(c, along);
      });
}

}  // namespace broadside::gpu

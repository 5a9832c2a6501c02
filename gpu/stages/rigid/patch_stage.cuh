// Makes patches of contact: of confirmed pairs, and of bodies at faces of the domain. Each pair or body has one thread,
// or a warp where shapes are meshes, or hulls whose edges must all be tried. RIGID 8.4.
#pragma once

#include "core/contact.hpp"
#include "core/method/rigid/end_patches.hpp"
#include "core/method/rigid/hull_manifold.hpp"
#include "core/method/rigid/kept_patch.hpp"
#include "core/method/rigid/known_gaps.hpp"
#include "core/method/rigid/make_manifolds.hpp"
#include "core/method/rigid/motion_reach.hpp"
#include "core/method/rigid/passing_by.hpp"
#include "core/method/rigid/pushed_motion.hpp"
#include "core/method/rigid/sweep.hpp"
#include "gpu/rigid/contact_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/contact_body.cuh"
#include "gpu/stages/rigid/patch_entries.cuh"
#include "gpu/stages/rigid/push_stage.cuh"
#include "gpu/stages/rigid/warp_lanes.cuh"
#include "gpu/stages/rigid/warp_shares.cuh"

namespace broadside::gpu {

// Appends the patches of a pair, one after the other, in the order in which they were made. Called by a whole warp: one
// atomic serves all of its lanes. kept: what the next step needs to carry the patch along, if there is exactly one;
// otherwise null.
__device__ inline void add_patches(const ContactView& f, std::uint32_t a, std::uint32_t b, const core::Manifold* found,
                                   int count, const core::KeptPatch* kept = nullptr) {
  const unsigned long long first = warp_append(static_cast<unsigned>(count), &f.counts->patches);
  if (count == 0 || first + static_cast<unsigned>(count) > f.patches.capacity) return;
  for (int k = 0; k < count; ++k) {
    const unsigned long long at = first + static_cast<unsigned>(k);
    f.patches.items[at] = {a, b, found[k]};
    if (f.memory.kept == nullptr) continue;
    if (kept != nullptr)
      f.memory.kept[at] = *kept;
    else
      f.memory.kept[at].count = 0;
  }
  if (is_moved(f, a)) atomicAdd(&f.memory.count[a], static_cast<std::uint32_t>(count));
  if (is_moved(f, b)) atomicAdd(&f.memory.count[b], static_cast<std::uint32_t>(count));
}

__device__ inline core::ContactPath path_of(const ContactView& f, std::uint32_t body) {
  return {pose_of(f, body), f.free_end[body]};
}

__device__ inline core::NearReach near_reach(const ContactView& f, core::Pair pair) {
  return {f.fall_m[pair.i] + f.fall_m[pair.j], f.pushers[pair.i].pushed.v, f.pushers[pair.j].pushed.v};
}

// Whether a patch leads to no contact in this step. kUnknown if lanes of this kind leave the pair to others.
template <typename Lanes>
__device__ core::QuickAnswer is_passing(const ContactView& f, core::Pair pair, const core::Manifold& found) {
  const RigidShapeView& a = f.shapes[f.shape_of_body[pair.i]];
  const RigidShapeView& b = f.shapes[f.shape_of_body[pair.j]];
  const core::ContactPath path_a = path_of(f, pair.i);
  const core::ContactPath path_b = path_of(f, pair.j);
  if (Lanes::kKnowsLongShapes && !Lanes::kLeavesHardPairs && f.follows_ways && are_followed(f, pair)) {
    const core::SweptWay way_a = core::free_way(path_a, a.balls.outer_m);
    const core::SweptWay way_b = core::free_way(path_b, b.balls.outer_m);
    const float thin_m = thinner_m(f, pair);
    if (core::moves_far(core::length_of(way_a), core::length_of(way_b), thin_m))
      return core::misses_patch<Lanes>(found, a.contact, way_a, b.contact, way_b, f.fall_m[pair.i] + f.fall_m[pair.j],
                                       thin_m)
                 ? core::QuickAnswer::kYes
                 : core::QuickAnswer::kNo;
  }
  return core::whether_passes_by<Lanes>(found, a.contact, path_a, b.contact, path_b,
                                        f.reach_m[pair.i] + f.reach_m[pair.j],
                                        core::near_m(found.normal, near_reach(f, pair)));
}

// Returns how many patches the pair has; kLeft if lanes of this kind leave it to others. known: gaps of two hulls, or
// null.
template <typename Lanes>
__device__ int touch_bodies(const ContactView& f, core::Pair pair, core::Manifold* found,
                            const core::KnownGaps* known = nullptr) {
  if (is_idle(f, pair.i) && is_idle(f, pair.j)) return 0;
  const core::ContactShape& a = f.shapes[f.shape_of_body[pair.i]].contact;
  const core::ContactShape& b = f.shapes[f.shape_of_body[pair.j]].contact;
  const core::ContactPath path_a = path_of(f, pair.i);
  const core::ContactPath path_b = path_of(f, pair.j);
  const float reach_m = f.reach_m[pair.i] + f.reach_m[pair.j];
  const int count = core::make_manifolds<Lanes>(a, path_a.start, b, path_b.start, reach_m, found,
                                                known != nullptr ? &known->start : nullptr);
  if (count == core::kLeft) return core::kLeft;
  int kept = 0;
  for (int k = 0; k < count; ++k) {
    const core::QuickAnswer passes = is_passing<Lanes>(f, pair, found[k]);
    if (passes == core::QuickAnswer::kUnknown) return core::kLeft;
    if (passes == core::QuickAnswer::kYes) continue;
    if (!f.follows_ways || !are_followed(f, pair))
      core::let_pass<Lanes>(found[k], a, path_a, b, path_b, reach_m, f.fall_m[pair.i] + f.fall_m[pair.j]);
    found[kept++] = found[k];
  }
  const float swing_m = f.pushers[pair.i].drift.w + f.pushers[pair.j].drift.w;
  return core::add_end_patches<Lanes>(a, path_a, b, path_b, swing_m, found, kept, known);
}

// The distance up to which a face is tested. A body at rest may be driven into a face as fast as its fastest neighbor
// approaches.
__device__ inline float reach_to_face_m(const ContactView& f, std::uint32_t body) {
  return __uint_as_float(f.pushed_m[body]) + f.reach_m[body];
}

__device__ inline bool may_touch_face(const ContactView& f, std::uint32_t body, std::uint32_t face) {
  return !is_idle(f, body) && core::may_reach_face(f.shape_boxes[body], reach_to_face_m(f, body), f.domain, face);
}

template <typename Lanes>
__device__ int touch_face(const ContactView& f, std::uint32_t body, std::uint32_t face, core::Manifold* found) {
  const float reach_m = reach_to_face_m(f, body);
  const core::ContactShape& shape = f.shapes[f.shape_of_body[body]].contact;
  const core::ContactPath path = path_of(f, body);
  const core::ContactPose& pose = f.face_poses[face];
  const int count = core::make_manifolds<Lanes>(shape, path.start, f.face_shapes[face], pose, reach_m, found);
  return core::add_end_patches<Lanes>(shape, path, f.face_shapes[face], {pose, pose}, f.pushers[body].drift.w, found,
                                      count);
}

__device__ inline core::PairAhead ahead_of(const ContactView& f, core::Pair pair) {
  return {f.reach_m[pair.i] + f.reach_m[pair.j], near_reach(f, pair),
          f.pushers[pair.i].drift.w + f.pushers[pair.j].drift.w, !f.follows_ways || !are_followed(f, pair)};
}

// By one lane. Returns false if a few bounds show that the pair has no patches, which saves the search for them. gaps:
// of a pair that may touch, what was found out on the way.
template <typename Lanes>
__device__ bool may_touch(const ContactView& f, core::Pair pair, core::KnownGaps& gaps) {
  if (is_idle(f, pair.i) && is_idle(f, pair.j)) return false;
  const core::PairAhead ahead = ahead_of(f, pair);
  if (Lanes::kKnowsLongShapes && !ahead.may_pass) return true;
  const core::ContactShape& a = f.shapes[f.shape_of_body[pair.i]].contact;
  const core::ContactShape& b = f.shapes[f.shape_of_body[pair.j]].contact;
  return !core::surely_passes<Lanes>(a, path_of(f, pair.i), b, path_of(f, pair.j), ahead, gaps);
}

// What the step before kept of the only patch of two bodies, or null.
__device__ inline const core::KeptPatch* kept_of_last_step(const ContactView& f, core::Pair pair) {
  const std::uint32_t body = is_moved(f, pair.i) ? pair.i : pair.j;
  const std::uint32_t other = body == pair.i ? pair.j : pair.i;
  const core::KeptPatch* kept = nullptr;
  each_entry(f.old_memory, body, [&](const PatchEntry& entry) {
    if (entry.other == other) kept = f.old_memory.kept + entry.patch;
  });
  return kept;
}

// Whether the pair's patch of the step before can be carried along with its bodies. If so, `found` is that patch at
// their present poses.
__device__ inline bool is_carried(const ContactView& f, core::Pair pair, core::Manifold& found,
                                  const core::KeptPatch*& kept) {
  if (f.asleep != nullptr || (is_idle(f, pair.i) && is_idle(f, pair.j))) return false;
  const core::ContactShape& a = f.shapes[f.shape_of_body[pair.i]].contact;
  const RigidShapeView& b = f.shapes[f.shape_of_body[pair.j]];
  const core::PairAhead ahead = ahead_of(f, pair);
  if (!core::may_be_carried(a, b.contact, ahead)) return false;
  kept = kept_of_last_step(f, pair);
  return kept != nullptr && core::carried(*kept, a, pose_of(f, pair.i), b.contact, pose_of(f, pair.j), b.balls.outer_m,
                                          ahead.near.falls_m, found);
}

// Passes pushes on along confirmed pairs, carries patches along, and lists the pairs that need new patches.
template <typename Team>
__device__ void carry_patches(const Team& team, const ContactView& f) {
  each_item_by_warps(team, f.counts->confirmed, false, [&](std::uint64_t k, bool is_item) {
    const core::Pair pair = is_item ? f.confirmed.items[k] : core::Pair{};
    if (is_item) pass_on_pushes(f, pair);
    core::Manifold found;
    const core::KeptPatch* kept = nullptr;
    const bool is_kept = is_item && is_carried(f, pair, found, kept);
    add_patches(f, pair.i, pair.j, &found, is_kept ? 1 : 0, kept);
    const std::uint64_t place = warp_append_one(is_item && !is_kept, &f.counts->fresh);
    if (is_item && !is_kept) f.fresh[place] = pair;
  });
}

// Adds the patches of two finely cut hulls. A single patch can be carried along in the next step; if there are more,
// some are of the end of the step, and none is carried.
__device__ inline void add_hull_patches(const ContactView& f, core::Pair pair, const core::Manifold* found, int count) {
  core::KeptPatch kept;
  if (count == 1) kept = core::kept_patch(found[0], pose_of(f, pair.i), pose_of(f, pair.j));
  add_patches(f, pair.i, pair.j, found, count, count == 1 ? &kept : nullptr);
}

// Lists the pairs that may touch: from the fresh pairs where there are hulls, otherwise from all confirmed pairs, along
// which it also passes pushes on. Without the lists, lanes whose pairs do not touch would wait for the others. Hulls
// that are clearly apart run other code than hulls that overlap, so these two are listed apart.
template <typename Lanes, typename Team>
__device__ void list_near_pairs(const Team& team, const ContactView& f) {
  constexpr bool kIsSpread = Lanes::kKnowsLongShapes;
  const bool are_fresh = Lanes::kKnowsLongShapes && f.fresh != nullptr;
  const core::Pair* const pairs = are_fresh ? f.fresh : f.confirmed.items;
  const std::uint64_t count = are_fresh ? f.counts->fresh : f.counts->confirmed;
  each_item_by_warps(team, count, kIsSpread, [&](std::uint64_t k, bool is_item) {
    const core::Pair pair = is_item ? pairs[k] : core::Pair{};
    if (is_item && !are_fresh) pass_on_pushes(f, pair);
    core::KnownGaps gaps;
    const bool is_near = is_item && may_touch<Lanes>(f, pair, gaps);
    const bool are_hulls = Lanes::kKnowsLongShapes && is_near && gaps.are_known;
    const std::uint64_t place = warp_append_one(is_near && !are_hulls, &f.counts->near);
    if (is_near && !are_hulls) f.near[place] = {pair, kNoGaps};
    if constexpr (Lanes::kKnowsLongShapes) {
      const bool are_apart = are_hulls && gaps.start.gap.least_m > 0.0F;
      const std::uint64_t from_begin = warp_append_one(are_hulls && !are_apart, &f.counts->near_hulls);
      const std::uint64_t from_end = warp_append_one(are_apart, &f.counts->apart_hulls);
      if (!are_hulls) return;
      const std::uint64_t at = are_apart ? f.confirmed.capacity - 1 - from_end : from_begin;
      f.hulls[at] = pair;
      f.hull_gaps[at] = gaps;
    }
  });
}

// Pairs first, then bodies at faces; by whole warps. No shape is a hull or a mesh.
template <typename Team>
__device__ void make_short_patches(const Team& team, const ContactView& f) {
  using Lanes = core::OneLaneOfShortShapes;
  list_near_pairs<Lanes>(team, f);
  team.sync();
  const std::uint64_t near = f.counts->near;
  each_item_by_warps(team, near + f.body_count, false, [&](std::uint64_t k, bool is_item) {
    core::Manifold found[core::kPatchesOfPair];
    const bool is_pair = is_item && k < near;
    if (__any_sync(kFullWarp, is_pair)) {
      const core::Pair pair = is_pair ? f.near[k].pair : core::Pair{};
      add_patches(f, pair.i, pair.j, found, is_pair ? touch_bodies<Lanes>(f, pair, found) : 0);
    }
    const bool is_body = is_item && !is_pair;
    if (!__any_sync(kFullWarp, is_body)) return;
    const auto body = static_cast<std::uint32_t>(is_body ? k - near : 0);
    for (std::uint32_t face = 0; face < core::kFaceCount; ++face) {
      const bool may = is_body && may_touch_face(f, body, face);
      if (!__any_sync(kFullWarp, may)) continue;
      const int count = may ? touch_face<Lanes>(f, body, face, found) : 0;
      add_patches(f, body, core::kFirstFace + face, found, count);
    }
  });
}

__device__ inline bool may_touch_faces(const ContactView& f, std::uint32_t body) {
  bool may = false;
  for (std::uint32_t face = 0; face < core::kFaceCount; ++face) may |= may_touch_face(f, body, face);
  return may;
}

// By a whole warp.
template <typename Lanes>
__device__ void make_face_patches(const ContactView& f, std::uint32_t body) {
  core::Manifold found[core::kPatchesOfPair];
  for (std::uint32_t face = 0; face < core::kFaceCount; ++face) {
    if (!may_touch_face(f, body, face)) continue;
    const int count = touch_face<Lanes>(f, body, face, found);
    add_patches(f, body, core::kFirstFace + face, found, lane() == 0 ? count : 0);
  }
}

__device__ inline bool is_hull(const ContactView& f, std::uint32_t body) {
  return f.shapes[f.shape_of_body[body]].contact.kind == core::ContactKind::kHull;
}

// Patches of hulls at faces of the domain, a warp a body.
template <typename Team>
__device__ void make_face_patches_of_hulls(const Team& team, const ContactView& f) {
  const auto prepare = [&](std::uint64_t k, bool is_item) {
    const auto body = static_cast<std::uint32_t>(k);
    return is_item && is_hull(f, body) && may_touch_faces(f, body);
  };
  each_item_in_step(team, f.body_count, prepare, [&](std::uint64_t k, unsigned of) {
    make_face_patches<WarpLanesOfHulls>(f, static_cast<std::uint32_t>(__shfl_sync(kFullWarp, k, of)));
  });
}

// Makes the patches of pairs of hulls, one lane for each pair. A pair that its lane leaves is added to the other near
// pairs.
template <typename Team>
__device__ void make_hull_patches(const Team& team, const ContactView& f) {
  const std::uint64_t near = f.counts->near_hulls;
  each_item_by_warps(team, near + f.counts->apart_hulls, true, [&](std::uint64_t k, bool is_item) {
    const std::uint64_t at = k < near ? k : f.confirmed.capacity - 1 - (k - near);
    core::Pair pair;
    core::Manifold found[core::kPatchesOfPair];
    int count = 0;
    if (is_item) {
      pair = f.hulls[at];
      count = touch_bodies<core::OneLaneOfHulls>(f, pair, found, &f.hull_gaps[at]);
    }
    const bool is_left = count == core::kLeft;
    const std::uint64_t place = warp_append_one(is_left, &f.counts->near);
    if (is_left) f.near[place] = {pair, static_cast<std::uint32_t>(at)};
    add_hull_patches(f, pair, found, is_left ? 0 : count);
  });
}

// Makes the patches of the other near pairs, and at faces those of bodies that are no hulls; a warp for each. Its lanes
// share the loops over corners, edges, faces and triangles, and the code is fetched once for all of them.
template <typename Team>
__device__ void make_long_patches(const Team& team, const ContactView& f) {
  // Pairs and bodies have a loop each, so that the few pairs are spread over all warps.
  const auto is_one = [](std::uint64_t, bool is_item) { return is_item; };
  each_item_in_step(team, f.counts->near, is_one, [&](std::uint64_t own_k, unsigned of) {
    const NearPair own = f.near[__shfl_sync(kFullWarp, own_k, of)];
    core::Manifold found[core::kPatchesOfPair];
    const int count =
        touch_bodies<WarpLanes>(f, own.pair, found, own.gaps == kNoGaps ? nullptr : &f.hull_gaps[own.gaps]);
    if (own.gaps == kNoGaps)
      add_patches(f, own.pair.i, own.pair.j, found, lane() == 0 ? count : 0);
    else
      add_hull_patches(f, own.pair, found, lane() == 0 ? count : 0);
  });
  const auto is_near_face = [&](std::uint64_t k, bool is_item) {
    const auto body = static_cast<std::uint32_t>(k);
    return is_item && !is_hull(f, body) && may_touch_faces(f, body);
  };
  each_item_in_step(team, f.body_count, is_near_face, [&](std::uint64_t k, unsigned of) {
    make_face_patches<WarpLanes>(f, static_cast<std::uint32_t>(__shfl_sync(kFullWarp, k, of)));
  });
}

}  // namespace broadside::gpu

// Patches of contact of confirmed pairs, and of bodies at faces of the domain; a thread a pair, a thread a body.
// RIGID 8.4.
#pragma once

#include "core/contact.hpp"
#include "core/method/rigid/end_patches.hpp"
#include "core/method/rigid/make_manifolds.hpp"
#include "core/method/rigid/motion_reach.hpp"
#include "core/method/rigid/passing_by.hpp"
#include "gpu/rigid/contact_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/contact_body.cuh"
#include "gpu/stages/rigid/warp_shares.cuh"

namespace broadside::gpu {

// Those of one pair follow each other, in the order in which they were made. By a whole warp: one atomic for all of its
// lanes.
__device__ inline void add_patches(const ContactView& f, std::uint32_t a, std::uint32_t b, const core::Manifold* found,
                                   int count) {
  const unsigned long long first = warp_append(static_cast<unsigned>(count), &f.counts->patches);
  if (count == 0 || first + static_cast<unsigned>(count) > f.patches.capacity) return;
  for (int k = 0; k < count; ++k) f.patches.items[first + static_cast<unsigned>(k)] = {a, b, found[k]};
  if (is_moved(f, a)) atomicAdd(&f.memory.count[a], static_cast<std::uint32_t>(count));
  if (is_moved(f, b)) atomicAdd(&f.memory.count[b], static_cast<std::uint32_t>(count));
}

__device__ inline core::ContactPath path_of(const ContactView& f, std::uint32_t body) {
  return {pose_of(f, body), f.free_end[body]};
}

// Returns how many patches the pair has.
__device__ inline int touch_bodies(const ContactView& f, core::Pair pair, core::Manifold* found) {
  const core::ContactShape& a = f.shapes[f.shape_of_body[pair.i]].contact;
  const core::ContactShape& b = f.shapes[f.shape_of_body[pair.j]].contact;
  const core::ContactPath path_a = path_of(f, pair.i);
  const core::ContactPath path_b = path_of(f, pair.j);
  const float reach_m = f.reach_m[pair.i] + f.reach_m[pair.j];
  const core::Vec3 pushed_a = f.pushers[pair.i].pushed.v;
  const core::Vec3 pushed_b = f.pushers[pair.j].pushed.v;
  const int count = core::make_manifolds(a, path_a.start, b, path_b.start, reach_m, found);
  int kept = 0;
  for (int k = 0; k < count; ++k)
    if (!core::passes_by(found[k], a, path_a, b, path_b, reach_m,
                         core::near_m(found[k].normal, f.fall_m[pair.i], pushed_a, f.fall_m[pair.j], pushed_b)))
      found[kept++] = found[k];
  const float swing_m = f.pushers[pair.i].drift.w + f.pushers[pair.j].drift.w;
  return core::add_end_patches(a, path_a, b, path_b, swing_m, found, kept);
}

// A body at rest may be driven into a face as fast as its fastest neighbor comes.
__device__ inline int touch_face(const ContactView& f, std::uint32_t body, std::uint32_t face, core::Manifold* found) {
  const float reach_m = __uint_as_float(f.pushed_m[body]) + f.reach_m[body];
  if (!core::may_reach_face(f.shape_boxes[body], reach_m, f.domain, face)) return 0;
  const core::ContactShape& shape = f.shapes[f.shape_of_body[body]].contact;
  const core::ContactPath path = path_of(f, body);
  const core::ContactPose& pose = f.face_poses[face];
  const int count = core::make_manifolds(shape, path.start, f.face_shapes[face], pose, reach_m, found);
  return core::add_end_patches(shape, path, f.face_shapes[face], {pose, pose}, f.pushers[body].drift.w, found, count);
}

// Pairs first, then bodies at faces; by whole warps.
template <typename Team>
__device__ void make_patches(const Team& team, const ContactView& f) {
  const std::uint64_t confirmed = f.counts->confirmed;
  each_item_by_warps(team, confirmed + f.body_count, f.has_long_contacts, [&](std::uint64_t k, bool is_item) {
    core::Manifold found[core::kPatchesOfPair];
    const bool is_pair = is_item && k < confirmed;
    if (__any_sync(kFullWarp, is_pair)) {
      const core::Pair pair = is_pair ? f.confirmed.items[k] : core::Pair{};
      add_patches(f, pair.i, pair.j, found, is_pair ? touch_bodies(f, pair, found) : 0);
    }
    const bool is_body = is_item && !is_pair;
    if (!__any_sync(kFullWarp, is_body)) return;
    const auto body = static_cast<std::uint32_t>(is_body ? k - confirmed : 0);
    for (std::uint32_t face = 0; face < core::kFaceCount; ++face) {
      const int count = is_body && is_moved(f, body) ? touch_face(f, body, face, found) : 0;
      add_patches(f, body, core::kFirstFace + face, found, count);
    }
  });
}

}  // namespace broadside::gpu

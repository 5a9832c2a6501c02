// Patches of contact of confirmed pairs, and of bodies at faces of the domain; a thread a pair, a thread a body. Then
// each moved body's list of its patches. RIGID 8.4.
#pragma once

#include "core/contact.hpp"
#include "core/method/rigid/make_manifolds.hpp"
#include "core/method/rigid/motion_reach.hpp"
#include "core/method/rigid/passing_by.hpp"
#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/rigid/oriented_stage.cuh"

namespace broadside::gpu {

__device__ inline bool is_moved(const RigidFrameView& f, std::uint32_t body) {
  return !core::is_face(body) && f.mass[body].inverse_mass > 0.0F;
}

// Those of one pair follow each other, in the order in which they were made.
__device__ inline void add_patches(const RigidFrameView& f, std::uint32_t a, std::uint32_t b,
                                   const core::Manifold* found, int count) {
  if (count == 0) return;
  const auto first = atomicAdd(&f.counts->patches, static_cast<unsigned long long>(count));
  if (first + count > f.patches.capacity) return;
  for (int k = 0; k < count; ++k) f.patches.items[first + k] = {a, b, found[k]};
  if (is_moved(f, a)) atomicAdd(&f.memory.count[a], static_cast<std::uint32_t>(count));
  if (is_moved(f, b)) atomicAdd(&f.memory.count[b], static_cast<std::uint32_t>(count));
}

__device__ inline core::ContactPath path_of(const RigidFrameView& f, std::uint32_t body) {
  return {pose_of(f, body), f.free_end[body]};
}

__device__ inline void touch_bodies(const RigidFrameView& f, core::Pair pair) {
  const core::ContactShape& a = f.shapes[f.shape_of_body[pair.i]].contact;
  const core::ContactShape& b = f.shapes[f.shape_of_body[pair.j]].contact;
  const core::ContactPath path_a = path_of(f, pair.i);
  const core::ContactPath path_b = path_of(f, pair.j);
  const float reach_m = f.reach_m[pair.i] + f.reach_m[pair.j];
  const core::Vec3 pushed_a = f.pushers[pair.i].pushed.v;
  const core::Vec3 pushed_b = f.pushers[pair.j].pushed.v;
  core::Manifold found[core::kPatchesOfPair];
  const int count = core::make_manifolds(a, path_a.start, b, path_b.start, reach_m, found);
  int kept = 0;
  for (int k = 0; k < count; ++k)
    if (!core::passes_by(found[k], a, path_a, b, path_b, reach_m,
                         core::near_m(found[k].normal, f.fall_m[pair.i], pushed_a, f.fall_m[pair.j], pushed_b)))
      found[kept++] = found[k];
  add_patches(f, pair.i, pair.j, found, kept);
}

// A body at rest may be driven into a face as fast as its fastest neighbor comes.
__device__ inline void touch_faces(const RigidFrameView& f, std::uint32_t body) {
  if (!is_moved(f, body)) return;
  const core::Box box = f.shape_boxes[body];
  const float reach_m = __uint_as_float(f.pushed_m[body]) + f.reach_m[body];
  for (std::uint32_t face = 0; face < core::kFaceCount; ++face) {
    if (!core::may_reach_face(box, reach_m, f.domain, face)) continue;
    core::Manifold found[core::kPatchesOfPair];
    const int count = core::make_manifolds(f.shapes[f.shape_of_body[body]].contact, pose_of(f, body),
                                           f.face_shapes[face], f.face_poses[face], reach_m, found);
    add_patches(f, body, core::kFirstFace + face, found, count);
  }
}

template <typename Team>
__device__ void make_patches(const Team& team, const RigidFrameView& f) {
  const std::uint64_t confirmed = f.counts->confirmed;
  for (std::uint64_t k = team.spread_rank(); k < confirmed + f.body_count; k += team.size()) {
    if (k < confirmed)
      touch_bodies(f, f.confirmed.items[k]);
    else
      touch_faces(f, static_cast<std::uint32_t>(k - confirmed));
  }
}

// Room in the lists, and no color taken.
template <typename Team>
__device__ void begin_lists(const Team& team, const RigidFrameView& f) {
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) {
    const std::uint32_t count = f.memory.count[i];
    f.memory.begin[i] =
        count == 0 ? 0
                   : static_cast<std::uint32_t>(atomicAdd(&f.counts->listed, static_cast<unsigned long long>(count)));
    f.memory.filled[i] = 0;
    f.coloring[i] = {};
  }
}

__device__ inline void list_patch(const RigidFrameView& f, std::uint32_t body, PatchEntry entry) {
  if (!is_moved(f, body)) return;
  f.memory.entries[f.memory.begin[body] + atomicAdd(&f.memory.filled[body], 1U)] = entry;
}

template <typename Team>
__device__ void fill_lists(const Team& team, const RigidFrameView& f) {
  for (std::uint64_t k = team.rank(); k < f.counts->patches; k += team.size()) {
    const core::ContactPatch& patch = f.patches.items[k];
    const auto index = static_cast<std::uint32_t>(k);
    list_patch(f, patch.a, {index, patch.b});
    list_patch(f, patch.b, {index, patch.a});
  }
}

}  // namespace broadside::gpu

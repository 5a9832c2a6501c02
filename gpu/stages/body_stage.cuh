// Stages with one thread per body: integration and boxes at the start, faces of the domain and the clamp at the end.
#pragma once

#include "core/method/contact_geometry.hpp"
#include "core/method/integrate.hpp"
#include "core/method/response.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/grid_stage.cuh"
#include "gpu/stages/octree_stage.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

__device__ inline core::Box local_box(const FrameView& f, std::uint32_t body) {
  return unpack(f.shapes.octree[std::uint64_t{f.shape_of_body[body]} * core::kBodyOctreeNodes]);
}

__device__ inline bool is_static(const FrameView& f, std::uint32_t body) {
  return !(f.previous.position[body].w > 0.0F);
}

// P(1) to P(3), P(5); and clean slates for the frame's later stages. The previous state stays as it is, so that a frame
// whose buffers turn out too small can be repeated.
template <typename Team>
__device__ void integrate(const Team& team, const FrameView& f) {
  for (std::uint64_t i = team.rank(); i < f.body_count; i += team.size()) {
    const PackedVec3 x = f.previous.position[i];
    const PackedVec3 v = f.previous.velocity[i];
    const core::Kinematics s = core::semi_implicit_euler({x.v, v.v}, x.w, f.gravity_m_s2, f.dt_s);
    const PackedVec3 new_x{s.x, x.w};
    const PackedVec3 new_v{s.v, v.w};
    f.detected.position[i] = f.next.position[i] = new_x;
    f.detected.velocity[i] = f.next.velocity[i] = new_v;
    const core::Box box = core::translated(local_box(f, static_cast<std::uint32_t>(i)), s.x);
    f.boxes[i] = pack(box, static_cast<std::uint32_t>(i), x.w > 0.0F ? 0U : 1U);
    if (f.broad.start == Start::kGrid) grid_count(f.broad.grid, i, box);
    if (f.broad.start == Start::kOctree) octree_count(f.broad.octree, i, box);
    f.degree[i] = 0;
  }
  if (team.rank() == 0) *f.counters = Counters{};
}

// The six half-spaces of the domain, then P(23).
template <typename Team>
__device__ void resolve_faces(const Team& team, const FrameView& f) {
  const std::uint64_t rounds = (f.body_count + team.size() - 1) / team.size();
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t i = round * team.size() + team.rank();
    PackedVec3 x;
    PackedVec3 v;
    core::Box local;
    bool moves = false;
    if (i < f.body_count) {
      x = f.next.position[i];
      v = f.next.velocity[i];
      moves = x.w > 0.0F;
      local = local_box(f, static_cast<std::uint32_t>(i));
    }
    // Called by whole warps: bodies at faces are few, and appends share one atomic.
    for (int face = 0; face < core::kFaceCount; ++face) {
      core::ContactGeometry geometry;
      if (moves) geometry = core::face_contact(core::translated(local, x.v), f.domain, face);
      if (!__any_sync(kFullWarp, geometry.exists)) continue;
      const unsigned long long place = warp_append(geometry.exists ? 1U : 0U, &f.counters->faces);
      if (!geometry.exists) continue;
      core::Contact contact;
      contact.a = static_cast<std::uint32_t>(i);
      contact.b = core::kFirstFace + static_cast<std::uint32_t>(face);
      contact.color = core::kFaceColor;
      contact.pre_a = {x.v, v.v};
      contact.pre_b = {};
      core::respond(contact, geometry, x.w, 0.0F, core::combine(f.material[i], f.face_material), f.parameters,
                    core::face_variant(f.variant));
      x.v = contact.post_a.x;
      v.v = contact.post_a.v;
      if (place < f.face_contacts.capacity) f.face_contacts.items[place] = contact;
    }
    if (!moves) continue;
    v.v = core::clipped(v.v, f.parameters.v_max_m_s);
    f.next.position[i] = x;
    f.next.velocity[i] = v;
  }
}

}  // namespace broadside::gpu

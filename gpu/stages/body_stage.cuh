// Stages with one thread per body: integration and boxes at the start, faces of the domain and the clamp at the end.
#pragma once

#include "core/method/contact_geometry.hpp"
#include "core/method/integrate.hpp"
#include "core/method/response.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/contact_words.cuh"
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

// w F of a body: gravity, then its springs in the scene's order.
__device__ inline core::Vec3 acceleration(const FrameView& f, std::uint64_t body, const core::Kinematics& state,
                                          float inverse_mass) {
  core::Vec3 sum = f.gravity_m_s2;
  if (f.spring_begin == nullptr) return sum;
  for (std::uint32_t k = f.spring_begin[body]; k < f.spring_begin[body + 1]; ++k)
    sum = sum + core::spring_acceleration(f.springs[k], state, inverse_mass);
  return sum;
}

// Whether the frame before was aborted and the host does not know yet. This one must leave everything as it is then:
// what it would write is the state to repeat from.
__device__ inline bool is_behind_aborted(const FrameView& f) {
  return f.is_behind_unseen && load_behind(&f.counters->is_aborted) != 0;
}

// P(1) to P(3), P(5); and clean slates for the frame's later stages. The previous state stays as it is, so that a frame
// whose buffers turn out too small can be repeated. Returns false, and has done nothing, behind an aborted frame. All
// threads see that alike: the counters are cleared only where there is nothing to see.
//
// By the last warps, one of a block: the first block waits longest for the kernel's parameters, and other warps have
// something else to see to meanwhile.
__device__ inline bool integrate(const GridPlaces& grid, const FrameView& f) {
  std::uint64_t i = grid.size() - 1 - grid.spread_rank();
  if (i >= f.body_count && is_behind_aborted(f)) return false;
  for (; i < f.body_count; i += grid.size()) {
    // Everything is asked for before any of it is looked at.
    const PackedVec3 x = f.previous.position[i];
    const PackedVec3 v = f.previous.velocity[i];
    const core::Box local = local_box(f, static_cast<std::uint32_t>(i));
    if (is_behind_aborted(f)) return false;
    const core::Kinematics before{x.v, v.v};
    const core::Kinematics s = core::semi_implicit_euler(before, x.w, acceleration(f, i, before, x.w), f.dt_s);
    const PackedVec3 new_x{s.x, x.w};
    const PackedVec3 new_v{s.v, v.w};
    f.detected.position[i] = f.next.position[i] = new_x;
    f.detected.velocity[i] = f.next.velocity[i] = new_v;
    const core::Box box = core::translated(local, s.x);
    f.boxes[i] = pack(box, static_cast<std::uint32_t>(i), x.w > 0.0F ? 0U : 1U);
    if (f.broad.start == Start::kGrid) grid_count(f.broad.grid, i, box);
    if (f.broad.start == Start::kOctree) octree_count(f.broad.octree, i, box);
    f.degree[i] = 0;
  }
  if (grid.rank() == 0) *f.counters = Counters{};
  return true;
}

// The contacts of one body with the six half-spaces of the domain, in their order; calls `found` for each.
template <typename Found>
__device__ void meet_faces(const FrameView& f, std::uint32_t body, const core::Box& local, float inverse_mass,
                           core::Kinematics& state, const Found& found) {
  for (int face = 0; face < core::kFaceCount; ++face) {
    const core::ContactGeometry geometry = core::face_contact(core::translated(local, state.x), f.domain, face);
    if (!geometry.exists) continue;
    core::Contact contact;
    contact.a = body;
    contact.b = core::kFirstFace + static_cast<std::uint32_t>(face);
    contact.color = core::kFaceColor;
    contact.pre_a = state;
    contact.pre_b = {};
    core::respond(contact, geometry, inverse_mass, 0.0F, core::combine(f.material[body], f.face_material), f.parameters,
                  core::face_variant(f.variant));
    state = contact.post_a;
    found(contact);
  }
}

// The six half-spaces of the domain, then P(23). Contacts are counted first and made again when there is a place for
// them: making them is cheap, and a warp takes its room with one atomic.
template <typename Team>
__device__ void resolve_faces(const Team& team, const FrameView& f) {
  const std::uint64_t rounds = (f.body_count + team.size() - 1) / team.size();
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t i = round * team.size() + team.spread_rank();
    const auto body = static_cast<std::uint32_t>(i);
    PackedVec3 x;
    PackedVec3 v;
    core::Box local;
    unsigned count = 0;
    core::Kinematics state;
    if (i < f.body_count) {
      x = f.next.position[i];
      v = f.next.velocity[i];
      local = local_box(f, body);
      state = {x.v, v.v};
    }
    const bool moves = x.w > 0.0F;
    if (moves) meet_faces(f, body, local, x.w, state, [&count](const core::Contact&) { ++count; });
    unsigned long long place = warp_append(count, &f.counters->faces);
    if (!moves) continue;
    if (count > 0) {
      core::Kinematics again{x.v, v.v};
      meet_faces(f, body, local, x.w, again, [&](const core::Contact& contact) {
        if (place < f.face_contacts.capacity) store_contact(f.face_contacts.items + place, contact);
        ++place;
      });
    }
    x.v = state.x;
    v.v = core::clipped(state.v, f.parameters.v_max_m_s);
    f.next.position[i] = x;
    f.next.velocity[i] = v;
  }
}

}  // namespace broadside::gpu

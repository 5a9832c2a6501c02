// Stages with one thread per body: integration and boxes at the start, faces of the domain and the clamp at the end.
#pragma once

#include "core/method/contact_geometry.hpp"
#include "core/method/integrate.hpp"
#include "core/method/response.hpp"
#include "gpu/frame/grid_frame_view.hpp"
#include "gpu/stages/broad/grid_stage.cuh"
#include "gpu/stages/broad/octree_stage.cuh"
#include "gpu/stages/grid/fetched.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/response/contact_words.cuh"

namespace broadside::gpu {

__device__ inline core::Box local_box(const FrameView& f, std::uint32_t body) {
  return fetched(f.shapes.octree + std::uint64_t{shape_of(f, body)} * core::kBodyOctreeNodes);
}

__device__ inline bool is_static(const FrameView& f, std::uint32_t body) {
  return !(f.previous.position[body].w > 0.0F);
}

// w F of a body, its acceleration: gravity, then its springs in the scene's order.
__device__ inline core::Vec3 acceleration(const FrameView& f, std::uint64_t body, const core::Kinematics& state,
                                          float inverse_mass) {
  core::Vec3 sum = f.gravity_m_s2;
  if (f.spring_begin == nullptr) return sum;
  for (std::uint32_t k = f.spring_begin[body]; k < f.spring_begin[body + 1]; ++k)
    sum = sum + core::spring_acceleration(f.springs[k], state, inverse_mass);
  return sum;
}

// A body's data when the frame begins.
struct BodyBefore {
  PackedVec3 x;  // w = inverse mass
  PackedVec3 v;
  core::Box local;

  BodyBefore() = default;
  __device__ BodyBefore(const FrameView& f, std::uint32_t body)
      : x(f.previous.position[body]), v(f.previous.velocity[body]), local(local_box(f, body)) {}

  __device__ bool is_static() const { return !(x.w > 0.0F); }
};

// A body's state and box at detection: P(1) to P(3), P(5).
struct BodyAtDetection {
  core::Kinematics state;
  core::Box box;

  __device__ BodyAtDetection(const FrameView& f, std::uint32_t body, const BodyBefore& before) {
    const core::Kinematics s{before.x.v, before.v.v};
    state = core::semi_implicit_euler(s, before.x.w, acceleration(f, body, s, before.x.w), f.dt_s);
    box = core::translated(before.local, state.x);
  }
};

// Not 0 if the frame before was aborted and the host does not know yet. Then this frame must write nothing, because it
// would overwrite the state from which that frame is repeated. All threads read the same value, since the counters are
// cleared only if that frame was not aborted. It is a word and not a bool, so that threads wait for the load only where
// they use it.
__device__ inline std::uint32_t is_behind_aborted(const FrameView& f) {
  return load_fresh_if(f.is_behind_unseen, &f.counters->is_aborted);
}

// Writes a body's state at detection, and clears what later stages count. The previous state is not written, so that a
// frame whose buffers are too small can be repeated.
__device__ inline void start_body(const FrameView& f, std::uint32_t body, const BodyBefore& before,
                                  const BodyAtDetection& now) {
  const PackedVec3 x{now.state.x, before.x.w};
  const PackedVec3 v{now.state.v, before.v.w};
  f.detected.position[body] = f.next.position[body] = x;
  f.detected.velocity[body] = f.next.velocity[body] = v;
  f.boxes[body] = pack(now.box, body, before.is_static() ? 1U : 0U);
  f.degree[body] = 0;
}

// The body with which a thread begins. The first bodies go to the last warp of each block, beginning with the last
// block, because the first block waits longest for the kernel's parameters, and a block's first warps have other work
// at that time.
__device__ inline std::uint64_t first_body(const GridPlaces& grid) {
  return grid.size() - 1 - grid.spread_rank();
}

// P(1) to P(3), P(5). After an aborted frame it does nothing and returns false.
__device__ inline bool integrate(const GridPlaces& grid, const GridFrameView& f) {
  const std::uint32_t is_aborted = is_behind_aborted(f);
  for (std::uint64_t i = first_body(grid); __any_sync(kFullWarp, i < f.body_count); i += grid.size()) {
    const auto body = static_cast<std::uint32_t>(min(i, std::uint64_t{f.body_count} - 1));
    const BodyBefore before(f, body);
    group_loads();
    if (is_aborted != 0) return false;
    if (i >= f.body_count) continue;
    const BodyAtDetection now(f, body, before);
    start_body(f, body, before, now);
    if (f.broad.start == Start::kGrid) grid_count(f.broad.grid, i, now.box);
    if (f.broad.start == Start::kOctree) octree_count(f.broad.octree, i, now.box);
  }
  // Warps without a body test this here. Before the loop, all warps would wait for it before they load a body.
  if (is_aborted != 0) return false;
  if (grid.rank() == 0) *f.counters = Counters{};
  return true;
}

// The faces of the domain that a body touches: bit k for face k.
__device__ inline unsigned faces_before(const FrameView& f, const core::Box& local, core::Vec3 x) {
  const core::Box box = core::translated(local, x);
  unsigned faces = 0;
#pragma unroll
  for (int face = 0; face < core::kFaceCount; ++face)
    faces |= (core::face_contact(box, f.domain, face).exists ? 1U : 0U) << face;
  return faces;
}

// Resolves a moving body's contacts with the six faces of the domain, in order, then applies P(23). Returns the state
// after that. Called by whole warps, also by lanes that have no body to move. Each lane finds its own next face, so
// that lanes with different faces are resolved together. `material` is called for the body's material.
template <typename Count, typename Material>
__device__ core::Kinematics settled_at_faces(const FrameView& f, std::uint32_t body, bool moves, const core::Box& local,
                                             float inverse_mass, const Material& material, core::Kinematics state,
                                             Count* demanded) {
  unsigned left = moves ? (1U << core::kFaceCount) - 1U : 0U;  // faces that come after the last one resolved
  for (;;) {
    const unsigned faces = left == 0 ? 0U : faces_before(f, local, state.x) & left;
    const bool has_one = faces != 0;
    if (!__any_sync(kFullWarp, has_one)) break;
    const Count place = warp_append_one(has_one, demanded);
    if (!has_one) continue;
    const int face = __ffs(static_cast<int>(faces)) - 1;
    left &= ~1U << face;
    core::Contact contact;
    contact.a = body;
    contact.b = core::kFirstFace + static_cast<std::uint32_t>(face);
    contact.color = core::kFaceColor;
    contact.pre_a = state;
    contact.pre_b = {};
    core::respond(contact, core::face_contact(core::translated(local, state.x), f.domain, face), inverse_mass, 0.0F,
                  core::combine(material(), f.face_material), f.parameters, core::face_variant(f.variant));
    state = contact.post_a;
    if (place < f.face_contacts.capacity) store_contact(f.face_contacts.items + place, contact);
  }
  if (moves) state.v = core::clipped(state.v, f.parameters.v_max_m_s);
  return state;
}

template <typename Team>
__device__ void resolve_faces(const Team& team, const FrameView& f) {
  const std::uint64_t rounds = (f.body_count + team.size() - 1) / team.size();
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t i = round * team.size() + team.spread_rank();
    const auto body = static_cast<std::uint32_t>(i);
    PackedVec3 x;
    PackedVec3 v;
    core::Box local;
    if (i < f.body_count) {
      x = f.next.position[i];
      v = f.next.velocity[i];
      local = local_box(f, body);
    }
    const bool moves = x.w > 0.0F;
    const auto material = [&] { return f.material[body]; };
    const core::Kinematics after =
        settled_at_faces(f, body, moves, local, x.w, material, {x.v, v.v}, &f.counters->faces);
    if (!moves) continue;
    f.next.position[i] = {after.x, x.w};
    f.next.velocity[i] = {after.v, v.w};
  }
}

}  // namespace broadside::gpu

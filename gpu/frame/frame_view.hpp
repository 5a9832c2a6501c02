// What the kernel of every frame gets by value: where the data of one simulation lie on the device.
// small_frame_view.hpp and grid_frame_view.hpp add what only small frames, or only grid frames, need.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/contact.hpp"
#include "core/engine/stage.hpp"
#include "core/material.hpp"
#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/method/levels.hpp"
#include "core/method/proximity.hpp"
#include "core/pair.hpp"
#include "core/parameters.hpp"
#include "core/scene/spring.hpp"
#include "core/variant.hpp"
#include "gpu/broad/broad_view.hpp"
#include "gpu/frame/placed_shape.hpp"
#include "gpu/scene/near_cells.hpp"
#include "gpu/scene/packed_box.hpp"
#include "gpu/scene/shape_tree.hpp"

namespace broadside::gpu {

// The least capacity of candidate pairs and of confirmed pairs.
constexpr std::uint64_t kLeastPairs = 1024;

enum class Solver : std::uint32_t { kColored, kJacobi, kRacing };

// Per shape, in body coordinates. All instances of a mesh share one shape.
struct ShapesView {
  std::uint32_t count = 0;
  const PackedBox* octree = nullptr;  // [shapes * 73] boxes of the body octree, in its order; empty nodes stay empty
  const PackedBox* level2 = nullptr;  // [shapes * 64] its level-2 boxes without the empty ones
  const std::uint32_t* level2_count = nullptr;  // [shapes]
  const TreeHeader* trees = nullptr;            // [shapes]
  const PackedBox* tree_nodes = nullptr;
  const PackedBox* tree_upper = nullptr;
  std::uint32_t tree_upper_count = 0;  // of all shapes; 0: trees are descended only if a body is far outside the domain
  const PackedVec3* tree_vertices = nullptr;
  const NearCells* near_cells = nullptr;  // [shapes]
  const std::uint8_t* near_lower = nullptr;
  const std::uint32_t* near_lists = nullptr;
  const NearEntry* near_entries = nullptr;
  const QuantizedVertex* quantized = nullptr;  // as tree_vertices
  float extent_m = 0.0F;                       // the largest coordinate of any shape's vertices
};

// Position (w = inverse mass) and velocity of every body, at one moment.
struct StateView {
  PackedVec3* position = nullptr;
  PackedVec3* velocity = nullptr;
};

// A touching pair, and its place among the contacts of each of the two bodies; kNoRank for a body that is never
// written.
constexpr std::uint32_t kNoRank = 0xFFFFFFFFU;
struct alignas(16) Link {
  std::uint32_t i = 0;
  std::uint32_t j = 0;
  std::uint32_t rank_i = 0;
  std::uint32_t rank_j = 0;
};

// A contact in the list of one of its bodies, in the order in which the body's contacts are resolved.
struct alignas(16) ListEntry {
  static constexpr std::uint32_t kIsOurs = 1U << 31;

  std::uint32_t contact = 0;
  std::uint32_t other = 0;       // the other body
  std::uint32_t rank_other = 0;  // the contact's place in the other's list
  std::uint32_t shape = 0;       // of the other body; kIsOurs: this body's thread resolves the contact
};

// A body while its contacts are resolved: how many of them are done, and the state that they left. These are two words
// of 16 bytes, each written whole. The lowest bit of `tag` repeats that of `done`, so that a reader can tell whether
// both words were written together. The bits above hold the lowest color that the body's next contact may have, as far
// as this body decides it.
struct alignas(16) LiveBody {
  core::Vec3 x;
  std::uint32_t done = 0;
  core::Vec3 v;
  std::uint32_t tag = 0;
};
static_assert(sizeof(Link) == 16 && sizeof(ListEntry) == 16 && sizeof(LiveBody) == 32,
              "read and written in words of 16 bytes");

// What the host reads after a frame. The device writes it to host memory: counts, and the device's clock at the begin
// of the frame and at the end of each stage.
struct Outcome {
  Counters counters;
  unsigned long long begin_ns = 0;
  unsigned long long stage_end_ns[core::kStageCount] = {};  // by core::Stage; without a frame, by FindStep
};

// All of it is fixed during a run, except `previous` and `next`, which change places after every frame, and `outcome`.
struct FrameView {
  std::uint32_t body_count = 0;
  core::Levels levels = core::Levels::kC;
  Solver solver = Solver::kColored;
  core::Variant variant = core::Variant::kSound;
  bool has_vertex_stage = true;
  float dt_s = 0.0F;
  core::Vec3 gravity_m_s2;
  core::Parameters parameters;
  core::Box domain;
  core::Material face_material;

  ShapesView shapes;
  const std::uint32_t* shape_of_body = nullptr;
  const core::Material* material = nullptr;
  // Springs by body, and in the scene's order for each: body i has springs[spring_begin[i] .. spring_begin[i + 1]).
  // Null: no springs.
  const core::Spring* springs = nullptr;
  const std::uint32_t* spring_begin = nullptr;
  StateView previous;
  StateView detected;
  StateView next;
  PackedBox* boxes = nullptr;  // at detection

  AppendView<core::Pair> pairs;
  AppendView<core::Pair> confirmed;      // for flat levels the same memory as pairs
  core::Proximity* proximity = nullptr;  // one per confirmed pair
  std::uint32_t stack_entries = 0;       // of each warp's stack in the proximity stage
  std::uint32_t block_bodies = 0;        // the most bodies whose contacts one block resolves alone
  std::uint32_t block_bytes = 0;         // shared memory of a block, without the fixed part
  Link* links = nullptr;                 // the touching pairs: as many as confirmed
  unsigned long long* keys = nullptr;    // [2 * links] order keys of the contacts of each written body, as they came
  ListEntry* lists = nullptr;            // [2 * links] contacts of each written body, in their order
  core::Contact* contacts = nullptr;     // one slot per link; depth 0 = no contact
  AppendView<core::Contact> face_contacts;

  std::uint32_t* degree = nullptr;      // [bodies] contacts of a written body
  std::uint32_t* list_begin = nullptr;  // [bodies]

  Counters* counters = nullptr;  // until this frame begins, they are those of the frame before
  // The barrier word.
  unsigned long long* barrier = nullptr;
  Outcome* outcome = nullptr;
  // True if the host has not seen yet how the frame before ended: if that was aborted, this frame does nothing.
  bool is_behind_unseen = false;
};

// If the scene has one shape, nothing is loaded.
BROADSIDE_HD std::uint32_t shape_of(const FrameView& f, std::uint32_t body) {
  return f.shapes.count == 1 ? 0U : f.shape_of_body[body];
}

// The body's shape at detection.
BROADSIDE_HD PlacedShape placed_shape(const FrameView& f, std::uint32_t body) {
  return {f.detected.position[body].v, shape_of(f, body)};
}

}  // namespace broadside::gpu

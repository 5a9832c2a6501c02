// What the frame kernel is given, by value: where everything of one simulation lies on the device.
#pragma once

#include <cstdint>

#include "core/contact.hpp"
#include "core/material.hpp"
#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/method/levels.hpp"
#include "core/method/proximity.hpp"
#include "core/pair.hpp"
#include "core/parameters.hpp"
#include "core/variant.hpp"
#include "gpu/packed_box.hpp"
#include "gpu/shape_tree.hpp"

namespace broadside::gpu {

enum class Start : std::uint32_t {
  kTiles,     // level 0 by brute force over 32 x 32 tiles of body boxes
  kSameNode,  // likewise, but only bodies stored in one node of the scene octree: printed-E2
  kGrid,      // level 0 from the hashed octree of grid_stage.cuh
  kNone,      // levels level1, A and B as published: their first level by brute force over all pairs of bodies
};

enum class Solver : std::uint32_t { kColored, kJacobi, kRacing };

// Per shape, in body coordinates. All instances of a mesh share one shape.
struct ShapesView {
  const PackedBox* octree = nullptr;  // [shapes * 73] boxes of the body octree, in its order; empty nodes stay empty
  const PackedBox* level2 = nullptr;  // [shapes * 64] its level-2 boxes without the empty ones
  const std::uint32_t* level2_count = nullptr;  // [shapes]
  const TreeHeader* trees = nullptr;            // [shapes]
  const PackedBox* tree_nodes = nullptr;
  const PackedVec3* tree_vertices = nullptr;
};

// Position (w = inverse mass) and velocity of every body, at one moment.
struct StateView {
  PackedVec3* position = nullptr;
  PackedVec3* velocity = nullptr;
};

// An append buffer. `stored` never passes its capacity; `demanded` counts on, so nothing is lost unseen.
template <typename T>
struct AppendView {
  T* items = nullptr;
  std::uint64_t capacity = 0;
};

// Counters of one frame; all are what was demanded.
struct Counters {
  unsigned long long pairs = 0;
  unsigned long long confirmed = 0;
  unsigned long long touching = 0;
  unsigned long long faces = 0;
  unsigned long long grid_cursor = 0;  // entries given out to buckets
  std::uint32_t colors = 0;
  std::uint32_t words_demanded = 0;  // of 64 colors a body; 0 = there were enough
  std::uint32_t is_left[3] = {};     // rounds use them in turn
  unsigned long long listed = 0;     // places given out in the lists of bodies
  std::uint32_t arrived = 0;         // of PartialGridTeam
  std::uint32_t is_aborted = 0;
};

constexpr int kStageCount = 6;

// What the host reads after a frame, in host memory that the device writes.
struct Outcome {
  Counters counters;
  unsigned long long stage_end_ns[kStageCount + 1] = {};  // [0] is the start of the frame
};

struct GridView {
  std::uint32_t bucket_mask = 0;          // buckets - 1; a power of two of buckets
  std::uint32_t* bucket_count = nullptr;  // zero between frames
  std::uint32_t* bucket_begin = nullptr;
  std::uint32_t* rank = nullptr;    // [bodies] place within the bucket
  PackedBox* entries = nullptr;     // [bodies] by bucket; low_tag = body, high_tag = level
  std::uint32_t* levels = nullptr;  // bit k: some body was on level k; bits are only ever set
  float cell_m = 0.0F;              // of level 0; level k has cells of cell_m / 2^k
};

// Fixed during a run, but for `previous` and `next`, which change places after every frame.
struct FrameView {
  std::uint32_t body_count = 0;
  Start start = Start::kGrid;
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
  StateView previous;
  StateView detected;
  StateView next;
  PackedBox* boxes = nullptr;  // at detection

  GridView grid;
  AppendView<core::Pair> pairs;
  AppendView<core::Pair> confirmed;      // flat: the same memory as pairs
  core::Proximity* proximity = nullptr;  // one per confirmed pair
  std::uint32_t stack_entries = 0;       // of each warp's stack in the proximity stage
  core::Pair* touching = nullptr;        // as many as confirmed
  std::uint32_t* color = nullptr;        // one per touching pair
  std::uint32_t* color_rank = nullptr;   // likewise: its place among the contacts of its color
  std::uint32_t* by_color = nullptr;     // likewise: the contacts by color
  std::uint32_t* list_slots = nullptr;   // [2 * touching] place in the list of each body
  std::uint32_t* lists = nullptr;        // [2 * touching] contacts of each moving body, by priority
  std::uint32_t* color_count = nullptr;  // [64 * color_words]
  std::uint32_t* color_begin = nullptr;  // [64 * color_words + 1]
  core::Contact* contacts = nullptr;     // one slot per touching pair; depth 0 = no contact
  AppendView<core::Contact> face_contacts;

  std::uint32_t* degree = nullptr;          // [bodies] contacts of a moving body
  std::uint32_t* list_begin = nullptr;      // [bodies]
  std::uint32_t* listed = nullptr;          // [bodies] contacts of the list that have a color
  std::uint32_t* front = nullptr;           // [2 * bodies] first contact of the list without color, by rounds
  std::uint32_t* unpublished = nullptr;     // [bodies] color that is in one copy of `taken` only
  unsigned long long* least_key = nullptr;  // [bodies] jacobi
  unsigned long long* taken = nullptr;      // [2 * bodies * color_words] colors in use at each body, by rounds
  std::uint32_t color_words = 1;
  core::Kinematics* sums = nullptr;  // jacobi

  Counters* counters = nullptr;
  Outcome* outcome = nullptr;
};

}  // namespace broadside::gpu

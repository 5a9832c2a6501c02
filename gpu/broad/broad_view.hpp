// The views that kernels of the broad phase get by value.
#pragma once

#include <cstdint>

#include "core/engine/stage.hpp"
#include "core/math/box.hpp"
#include "core/method/scene_octree.hpp"
#include "core/pair.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

// Where candidates come from.
enum class Start : std::uint32_t {
  kTiles,   // level 0 by brute force over 32 x 32 tiles of body boxes
  kGrid,    // level 0 from the hashed octree of grid_stage.cuh
  kOctree,  // level 0 from the published scene octree: octree_stage.cuh
  kHash,    // level 0 from the paper's comparison, a spatial hash: hash_stage.cuh
  kNone,    // levels level1, A and B as published: their first level by brute force over all pairs of bodies
  kBulk,    // bulk pairs: as kGrid, but nothing beside the pairs is computed: bulk_search.cuh
};

// The steps of a broad phase that runs alone, in their order; each has a time.
enum class FindStep : std::uint32_t {
  kCount,    // boxes into cells
  kPlace,    // cells into memory
  kScatter,  // boxes by cell
  kSearch,   // boxes against the boxes of their cells
};
static_assert(static_cast<std::size_t>(FindStep::kSearch) < core::kStageCount, "Outcome has room for their ends");

// An append buffer. Nothing is stored past its capacity, but the count of what was demanded goes on, so that no loss is
// unnoticed.
template <typename T>
struct AppendView {
  T* items = nullptr;
  std::uint64_t capacity = 0;
};

// Counters of one frame; they count what was demanded, not what was stored.
struct Counters {
  unsigned long long pairs = 0;
  unsigned long long confirmed = 0;
  unsigned long long touching = 0;
  unsigned long long faces = 0;
  unsigned long long entries = 0;       // of the spatial hash: bodies times cells
  unsigned long long entry_cursor = 0;  // entries given out to buckets
  unsigned long long listed = 0;        // places given out in the lists of bodies
  unsigned long long measured = 0;      // confirmed pairs given out to warps that measure their proximity
  unsigned long long group_pairs = 0;   // pairs of groups of boxes: grouped_view.hpp
  unsigned long long digest = 0;        // sum of the shares of its blocks so far
  std::uint32_t oversized = 0;          // bodies in too many cells of the spatial hash
  std::uint32_t arrived = 0;            // arrivals at the barrier of PartialGridTeam
  std::uint32_t colors = 0;
  std::uint32_t is_aborted = 0;
  std::uint32_t digested = 0;  // blocks of the digest's kernel that have added their share
};

// Buckets are in chunks of kBucketChunk, each with one more word in `begin`: bucket b has the entries begin[place(b)]
// .. begin[place(b) + 1], and those of neighboring buckets of a chunk follow each other.
constexpr std::uint32_t kBucketChunk = 128;
constexpr std::uint64_t bucket_words(std::uint64_t buckets) {
  return buckets + (buckets + kBucketChunk - 1) / kBucketChunk;
}

struct GridView {
  std::uint32_t bucket_mask = 0;    // buckets - 1; a power of two of buckets, whole chunks
  std::uint32_t axis_bits = 0;      // how many bits of each coordinate go into a bucket unhashed
  std::int32_t first_cell[3] = {};  // the cell of level 0 that has the world's lower corner
  std::uint32_t* count = nullptr;   // [buckets]; zero between frames
  std::uint32_t* begin = nullptr;   // [bucket_words(buckets)]
  std::uint32_t* rank = nullptr;    // [bodies] place within the bucket
  PackedBox* entries = nullptr;     // [bodies] by bucket; low_tag = body, high_tag: see grid_stage.cuh
  std::uint32_t* levels = nullptr;  // bit k: some body was on level k; bits are only ever set
  float cell_m = 0.0F;              // of level 0; level k has cells of cell_m / 2^k
  float cells_per_m = 0.0F;         // its inverse
};

// One body in one cell of the spatial hash.
struct alignas(16) HashEntry {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  std::uint32_t body = 0;
};

// A body that touches more cells is entered in none. As in hash-cpu: 16 cells a side.
inline constexpr std::uint64_t kMostHashCells = 4096;

struct HashView {
  float cells_per_m = 0.0F;
  std::uint32_t bucket_mask = 0;
  std::uint32_t* count = nullptr;   // [buckets]; zero between frames
  std::uint32_t* begin = nullptr;   // [bucket_words(buckets)]
  std::uint32_t* cursor = nullptr;  // [buckets]
  AppendView<HashEntry> entries;
  std::uint32_t* oversized = nullptr;  // [bodies]
};

// The published scene octree: bodies by node, nodes in preorder.
struct OctreeView {
  core::SceneGrid grid;
  bool same_node_only = false;          // printed-E2
  std::uint32_t* node_count = nullptr;  // [nodes]; zero between frames
  std::uint32_t* node_begin = nullptr;  // [nodes + 1]
  std::uint32_t* rank = nullptr;        // [bodies] place within the node
  PackedBox* sorted = nullptr;          // [bodies] low_tag = body
  std::uint32_t* range_end = nullptr;   // [bodies] one past the last candidate of the body at this place
};

struct BroadView {
  Start start = Start::kGrid;
  GridView grid;
  HashView hash;
  OctreeView octree;
};

}  // namespace broadside::gpu

// The fast exact broad phase: a loose octree of unbounded depth, kept as a hash of its occupied cells. A body is in the
// cell of its box's lower corner on the lowest level whose cells are as large as the box, so a cell of size c holds
// boxes that reach at most c past it; cells of a level halve those of the level above.
#pragma once

#include "gpu/frame_view.hpp"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// Level 20 has cells a millionth of the largest box; smaller boxes share it.
constexpr int kGridLevels = 21;

struct CellCorner {
  int x = 0;
  int y = 0;
  int z = 0;

  __device__ bool operator==(const CellCorner& o) const { return x == o.x && y == o.y && z == o.z; }
};

// Monotone, also where it saturates: a cell far outside holds whatever lies beyond it.
__device__ inline int cell_index(float v, float cells_per_m) {
  constexpr float kFar = 1073741824.0F;
  return static_cast<int>(fminf(fmaxf(floorf(v * cells_per_m), -kFar), kFar));
}

__device__ inline CellCorner cell_of(core::Vec3 v, float cells_per_m) {
  return {cell_index(v.x, cells_per_m), cell_index(v.y, cells_per_m), cell_index(v.z, cells_per_m)};
}

__device__ inline float cell_size(const GridView& g, int level) {
  return ldexpf(g.cell_m, -level);
}

__device__ inline float largest_magnitude(core::Vec3 v) {
  return fmaxf(fabsf(v.x), fmaxf(fabsf(v.y), fabsf(v.z)));
}

// The finest level whose cells are at least as large as the box, and not so fine that a cell is lost in the rounding of
// the coordinates (2^-18 of them is 32 units in the last place).
__device__ inline int grid_level(const GridView& g, const core::Box& box) {
  const core::Vec3 side = box.max - box.min;
  const float far = fmaxf(largest_magnitude(box.min), largest_magnitude(box.max)) * 0x1p-18F;
  const float needed = fmaxf(fmaxf(side.x, side.y), fmaxf(side.z, far));
  int level = 0;
  while (level + 1 < kGridLevels && cell_size(g, level + 1) >= needed) ++level;
  return level;
}

__device__ inline std::uint32_t every_third_bit(std::uint32_t v) {
  v &= 0x3FFU;
  v = (v | v << 16) & 0x030000FFU;
  v = (v | v << 8) & 0x0300F00FU;
  v = (v | v << 4) & 0x030C30C3U;
  return (v | v << 2) & 0x09249249U;
}

// Low bits in Morton order, so that near cells lie near in memory; what is above them, and the level, scatters whole
// blocks of cells over the table.
__device__ inline std::uint32_t bucket_of(const GridView& g, CellCorner c, int level) {
  const int bits = min(10, (32 - __clz(g.bucket_mask)) / 3);
  const std::uint32_t near = every_third_bit(static_cast<std::uint32_t>(c.x) & ((1U << bits) - 1U)) |
                             every_third_bit(static_cast<std::uint32_t>(c.y) & ((1U << bits) - 1U)) << 1 |
                             every_third_bit(static_cast<std::uint32_t>(c.z) & ((1U << bits) - 1U)) << 2;
  std::uint32_t far =
      static_cast<std::uint32_t>(c.x >> bits) * 0x9E3779B1U ^ static_cast<std::uint32_t>(c.y >> bits) * 0x85EBCA6BU ^
      static_cast<std::uint32_t>(c.z >> bits) * 0xC2B2AE35U ^ static_cast<std::uint32_t>(level) * 0x27D4EB2FU;
  far = (far ^ far >> 15) * 0x2C1B3C6DU;
  return (near ^ far ^ far >> 16) & g.bucket_mask;
}

// Counts this box into its bucket. The place within the bucket is whatever the order of the threads makes it: nothing
// that follows depends on it.
__device__ inline void grid_count(const GridView& g, std::uint64_t body, const core::Box& box) {
  const int level = grid_level(g, box);
  const std::uint32_t bucket = bucket_of(g, cell_of(box.min, 1.0F / cell_size(g, level)), level);
  g.rank[body] = atomicAdd(&g.bucket_count[bucket], 1U);
  if ((*static_cast<volatile std::uint32_t*>(g.levels) >> level & 1U) == 0) atomicOr(g.levels, 1U << level);
}

// Gives every bucket its range of entries; ranges come in no particular order beyond a warp's.
template <typename Team>
__device__ void grid_place_buckets(const Team& team, const GridView& g, unsigned long long* cursor) {
  const std::uint64_t buckets = std::uint64_t{g.bucket_mask} + 1;
  for (std::uint64_t first = warp_rank(team) * 128; first < buckets; first += warp_count(team) * 128) {
    const std::uint64_t mine = first + lane() * 4;
    std::uint32_t counts[4];
    std::uint32_t sum = 0;
#pragma unroll
    for (int k = 0; k < 4; ++k) sum += counts[k] = mine + k < buckets ? g.bucket_count[mine + k] : 0U;
    auto place = static_cast<std::uint32_t>(warp_append(sum, cursor));
#pragma unroll
    for (int k = 0; k < 4; ++k) {
      if (mine + k < buckets) g.bucket_begin[mine + k] = place;
      place += counts[k];
    }
  }
}

template <typename Team>
__device__ void grid_scatter(const Team& team, const GridView& g, const PackedBox* boxes, std::uint32_t count) {
  for (std::uint64_t i = team.rank(); i < count; i += team.size()) {
    PackedBox box = boxes[i];
    const int level = grid_level(g, unpack(box));
    const std::uint32_t bucket = bucket_of(g, cell_of(box.min, 1.0F / cell_size(g, level)), level);
    // Tags of an entry: the body, and its level with the static mark above it.
    box.high_tag = static_cast<std::uint32_t>(level) | box.high_tag << 31;
    box.low_tag = static_cast<std::uint32_t>(i);
    g.entries[g.bucket_begin[bucket] + g.rank[i]] = box;
  }
}

// Pairs found by one warp, kept in shared memory so that the warp takes its room in the append buffer at once.
struct PairQueue {
  static constexpr std::uint32_t kRoom = 96;
  std::uint32_t count;
  core::Pair pairs[kRoom];
};

__device__ inline void push_pair(PairQueue& queue, AppendView<core::Pair> out, unsigned long long* demanded,
                                 core::Pair p) {
  const std::uint32_t place = atomicAdd(&queue.count, 1U);
  if (place < PairQueue::kRoom) {
    queue.pairs[place] = p;
    return;
  }
  const unsigned long long direct = atomicAdd(demanded, 1ULL);
  if (direct < out.capacity) out.items[direct] = p;
}

__device__ inline void flush_pairs(PairQueue& queue, AppendView<core::Pair> out, unsigned long long* demanded) {
  __syncwarp();
  const std::uint32_t count = min(queue.count, PairQueue::kRoom);
  unsigned long long base = 0;
  if (lane() == 0 && count > 0) base = atomicAdd(demanded, static_cast<unsigned long long>(count));
  base = __shfl_sync(kFullWarp, base, 0);
  for (std::uint32_t k = lane(); k < count; k += 32)
    if (base + k < out.capacity) out.items[base + k] = queue.pairs[k];
  __syncwarp();
  if (lane() == 0) queue.count = 0;
  __syncwarp();
}

// One box against one level of cells. A box b of that level overlaps q only if its lower corner is between q.min - c
// and q.max; the sixteenth of a cell and the 2^-20 of the coordinate cover every rounding on the way there (at most a
// few units in the last place, 2^-23). Two boxes of the same level would find each other twice: the one in the
// lexicographically lower cell finds, in one cell the one of the lower id.
template <typename Found>
__device__ void visit_level(const GridView& g, const PackedBox& q, int own_level, int level, const Found& found) {
  const float c = cell_size(g, level);
  const float cells_per_m = 1.0F / c;
  const auto reach = [c](float v) { return v - c - (c * 0.0625F + fabsf(v) * 0x1p-20F); };
  CellCorner low = cell_of({reach(q.min.x), reach(q.min.y), reach(q.min.z)}, cells_per_m);
  const CellCorner high = cell_of(q.max, cells_per_m);
  const CellCorner own = cell_of(q.min, cells_per_m);
  const bool is_own_level = level == own_level;
  if (is_own_level) low.z = own.z;
  for (int z = low.z; z <= high.z; ++z) {
    const int first_y = is_own_level && z == own.z ? own.y : low.y;
    for (int y = first_y; y <= high.y; ++y) {
      const int first_x = is_own_level && z == own.z && y == own.y ? own.x : low.x;
      for (int x = first_x; x <= high.x; ++x) {
        const CellCorner cell{x, y, z};
        const std::uint32_t bucket = bucket_of(g, cell, level);
        const std::uint32_t count = g.bucket_count[bucket];
        const std::uint32_t begin = g.bucket_begin[bucket];
        for (std::uint32_t k = begin; k < begin + count; ++k) {
          const PackedBox other = g.entries[k];
          if (!core::overlaps(unpack(q), unpack(other))) continue;
          // Buckets are shared: this entry may belong to another cell, from which it is found too.
          if (static_cast<int>(other.high_tag & 0xFFU) != level || !(cell_of(other.min, cells_per_m) == cell)) continue;
          if (is_own_level && cell == own && other.low_tag <= q.low_tag) continue;
          if ((q.high_tag & other.high_tag) >> 31 != 0) continue;
          found(core::make_pair_of(q.low_tag, other.low_tag));
        }
      }
    }
  }
}

// Every pair is found from its smaller box: a box looks at its own level and at those of larger cells, some 27 cells
// each, so that a giant's many overlaps are spread over its many partners.
template <typename Team>
__device__ void grid_find(const Team& team, const GridView& g, std::uint32_t count, AppendView<core::Pair> out,
                          unsigned long long* demanded, PairQueue& queue) {
  if (lane() == 0) queue.count = 0;
  __syncwarp();
  const std::uint32_t occupied = *static_cast<volatile std::uint32_t*>(g.levels);
  const std::uint64_t rounds = (count + team.size() - 1) / team.size();
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t k = round * team.size() + team.rank();
    if (k < count) {
      const PackedBox q = g.entries[k];
      const int own_level = static_cast<int>(q.high_tag & 0xFFU);
      for (int level = 0; level <= own_level; ++level)
        if ((occupied >> level & 1U) != 0)
          visit_level(g, q, own_level, level, [&](core::Pair p) { push_pair(queue, out, demanded, p); });
    }
    flush_pairs(queue, out, demanded);
  }
}

template <typename Team>
__device__ void grid_clear(const Team& team, const GridView& g) {
  const std::uint64_t buckets = std::uint64_t{g.bucket_mask} + 1;
  for (std::uint64_t b = team.rank(); b < buckets; b += team.size()) g.bucket_count[b] = 0;
}

}  // namespace broadside::gpu

// The fast exact broad phase: a loose octree of unbounded depth, kept as a hash of its occupied cells. A body is in the
// cell of its box's lower corner on the lowest level whose cells are as large as the box, so a cell of size c holds
// boxes that reach at most c past it; cells of a level halve those of the level above. Cells that follow each other in
// x are neighboring buckets, so that a row of cells is one run of entries.
#pragma once

#include "gpu/broad_view.hpp"
#include "gpu/stages/bucket_stage.cuh"
#include "gpu/stages/pair_queue.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// Level 20 has cells a millionth of the largest box; smaller boxes share it.
constexpr int kGridLevels = 21;
// Cells of a row that are sure to be neighboring buckets: aligned runs of 32.
constexpr std::uint32_t kRowBits = 5;
static_assert((1U << kRowBits) <= kBucketChunk, "a row's buckets lie in one chunk");

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
  for (float next = 0.5F * g.cell_m; level + 1 < kGridLevels && next >= needed; next *= 0.5F) ++level;
  return level;
}

// The bits of a 16-bit number, two apart.
__device__ inline std::uint32_t every_second_bit(std::uint32_t v) {
  v = (v | v << 8) & 0x00FF00FFU;
  v = (v | v << 4) & 0x0F0F0F0FU;
  v = (v | v << 2) & 0x33333333U;
  return (v | v << 1) & 0x55555555U;
}

// Rows of 32 cells, rows near each other in y and z near each other, then slabs in x: where the table has a bucket for
// every cell of the world, that is all. What is above these bits, and the level, scatters whole blocks over the table.
__device__ inline std::uint32_t bucket_of(const GridView& g, CellCorner c, int level) {
  const auto offset = [level](int first) { return static_cast<std::uint32_t>(first) << level; };
  const std::uint32_t x = static_cast<std::uint32_t>(c.x) - offset(g.first_cell[0]);
  const std::uint32_t y = static_cast<std::uint32_t>(c.y) - offset(g.first_cell[1]);
  const std::uint32_t z = static_cast<std::uint32_t>(c.z) - offset(g.first_cell[2]);
  const std::uint32_t low = (1U << g.axis_bits) - 1U;
  const std::uint32_t x_bits = max(g.axis_bits, kRowBits);
  const std::uint32_t near = (x & ((1U << kRowBits) - 1U)) |
                             (every_second_bit(y & low) | every_second_bit(z & low) << 1) << kRowBits |
                             ((x & ((1U << x_bits) - 1U)) >> kRowBits) << (kRowBits + 2 * g.axis_bits);
  std::uint32_t far = (x >> x_bits) * 0x9E3779B1U ^ (y >> g.axis_bits) * 0x85EBCA6BU ^
                      (z >> g.axis_bits) * 0xC2B2AE35U ^ static_cast<std::uint32_t>(level) * 0x27D4EB2FU;
  far = (far ^ far >> 15) * 0x2C1B3C6DU;
  return (near ^ (far ^ far >> 16) << kRowBits) & g.bucket_mask;
}

// Counts this box into its bucket. The place within the bucket is whatever the order of the threads makes it: nothing
// that follows depends on it.
__device__ inline void grid_count(const GridView& g, std::uint64_t body, const core::Box& box) {
  const int level = grid_level(g, box);
  const std::uint32_t bucket = bucket_of(g, cell_of(box.min, 1.0F / cell_size(g, level)), level);
  g.rank[body] = atomicAdd(&g.count[bucket], 1U);
  if ((*static_cast<volatile std::uint32_t*>(g.levels) >> level & 1U) == 0) atomicOr(g.levels, 1U << level);
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
    g.entries[g.begin[bucket_place(bucket)] + g.rank[i]] = box;
  }
}

// Cells of one level in which the partners of a box may be. A box b of that level overlaps q only if its lower corner
// is between q.min - c and q.max; a thousandth of a cell and the 2^-20 of the coordinate cover every rounding on the
// way there (at most a few units in the last place, 2^-23 of a coordinate that is at most 2^18 cells).
struct CellRange {
  CellCorner low;
  CellCorner high;
};
__device__ inline CellRange partner_cells(const PackedBox& q, float c, float cells_per_m) {
  const auto reach = [c](float v) { return v - c - (c * 0x1p-10F + fabsf(v) * 0x1p-20F); };
  return {cell_of({reach(q.min.x), reach(q.min.y), reach(q.min.z)}, cells_per_m), cell_of(q.max, cells_per_m)};
}

// One box against one row of cells of one level. `is_own_row`: the box's own cell is the first, in which the entry of
// the lower id finds.
template <typename Found>
__device__ void visit_row(const GridView& g, const PackedBox& q, int level, float cells_per_m, int x, int last_x, int y,
                          int z, bool is_own_row, const Found& found) {
  const int own_x = x;
  while (x <= last_x) {
    const std::uint32_t bucket = bucket_of(g, {x, y, z}, level);
    const std::uint32_t room = (1U << kRowBits) - 1U - (bucket & ((1U << kRowBits) - 1U));
    const std::uint32_t more = min(static_cast<std::uint32_t>(last_x - x), room);
    const std::uint32_t end = g.begin[bucket_place(bucket + more) + 1];
    for (std::uint32_t k = g.begin[bucket_place(bucket)]; k < end; ++k) {
      const PackedBox other = g.entries[k];
      if (!core::overlaps(unpack(q), unpack(other))) continue;
      // Buckets are shared: this entry may belong to another row, from which it is found too.
      if (static_cast<int>(other.high_tag & 0xFFU) != level) continue;
      const CellCorner cell = cell_of(other.min, cells_per_m);
      if (cell.y != y || cell.z != z || cell.x < x || cell.x > x + static_cast<int>(more)) continue;
      if (is_own_row && cell.x == own_x && other.low_tag <= q.low_tag) continue;
      if ((q.high_tag & other.high_tag) >> 31 != 0) continue;
      found(core::make_pair_of(q.low_tag, other.low_tag));
    }
    x += static_cast<int>(more) + 1;
  }
}

// One box against one level of cells. Two boxes of the same level would find each other twice: the one in the
// lexicographically lower cell finds, in one cell the one of the lower id.
template <typename Found>
__device__ void visit_level(const GridView& g, const PackedBox& q, int own_level, int level, const Found& found) {
  const float c = cell_size(g, level);
  const float cells_per_m = 1.0F / c;
  const CellRange range = partner_cells(q, c, cells_per_m);
  if (level != own_level) {
    for (int z = range.low.z; z <= range.high.z; ++z)
      for (int y = range.low.y; y <= range.high.y; ++y)
        visit_row(g, q, level, cells_per_m, range.low.x, range.high.x, y, z, false, found);
    return;
  }
  const CellCorner own = cell_of(q.min, cells_per_m);
  visit_row(g, q, level, cells_per_m, own.x, range.high.x, own.y, own.z, true, found);
  for (int y = own.y + 1; y <= range.high.y; ++y)
    visit_row(g, q, level, cells_per_m, range.low.x, range.high.x, y, own.z, false, found);
  for (int z = own.z + 1; z <= range.high.z; ++z)
    for (int y = range.low.y; y <= range.high.y; ++y)
      visit_row(g, q, level, cells_per_m, range.low.x, range.high.x, y, z, false, found);
}

// Every pair is found from its smaller box: a box looks at its own level and at those of larger cells, so that a
// giant's many overlaps are spread over its many partners.
template <typename Team>
__device__ void grid_find(const Team& team, const GridView& g, std::uint32_t count, AppendView<core::Pair> out,
                          unsigned long long* demanded, PairQueue& queue) {
  open_queue(queue);
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
    flush_if_filled(queue, out, demanded);
  }
  flush_pairs(queue, out, demanded);
}

}  // namespace broadside::gpu

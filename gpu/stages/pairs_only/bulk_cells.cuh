// The cell in which a box of bulk pairs lies: the loose octree of grid_stage.cuh, changed for another search. Boxes lie
// on even levels only, so a box has from a quarter of its cell's size up to all of it: looking at fewer levels is worth
// more tests on each. An entry is half as large, since its box is rounded to two words; bulk_search.cuh says how that
// helps.
#pragma once

#include "gpu/broad/bulk_view.hpp"
#include "gpu/stages/broad/bucket_stage.cuh"
#include "gpu/stages/broad/grid_stage.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// Coordinates are counted in 1024ths of a cell of the box's own level; shifted by one more bit, such an integer counts
// for the next coarser level. Monotone, also where it saturates: the last cell holds everything that lies beyond it.
// That far out, at 2^20 cells, rounding may make a box a quarter longer than a cell; farther out it could be twice as
// long.
constexpr int kFineBits = 10;

__device__ inline int fine_index(float v, float cells_per_m) {
  return floor_to_int(fminf(fmaxf(v * cells_per_m, -kFarthestCell), kFarthestCell) * (1 << kFineBits));
}

__device__ inline CellCorner fine_corner(core::Vec3 v, float cells_per_m) {
  return {fine_index(v.x, cells_per_m), fine_index(v.y, cells_per_m), fine_index(v.z, cells_per_m)};
}

// The cell of a corner on a level that is `coarser` levels above the one in whose cells the corner is counted. Cells
// may be shorter along x. A row of cells is one run of entries, which then ends nearer to where partners may be, and
// the number of rows stays the same.
__device__ inline CellCorner cell_above(const BulkView& g, CellCorner fine, int coarser) {
  const int shift = kFineBits + coarser;
  return {fine.x >> (shift - static_cast<int>(g.x_halvings)), fine.y >> shift, fine.z >> shift};
}

// The lowest cell that may have partners. A box b of a level overlaps another box only if b's lower corner is between
// min - c and max of that box, where c is the width of the level's cells. One 1024th of a cell and 2^-20 of the
// coordinate cover all rounding in between: that of a side that is at most c only after rounding, that of the products
// by which coordinates are counted, and that of boxes far outside, which are longer than c by a unit in the last place
// of their coordinates (2^-23 of them each).
__device__ inline int lowest_corner(int fine_min, int coarser) {
  const int f = fine_min >> coarser;
  return f - 1 - (abs(f) >> 20) - (1 << kFineBits);
}
__device__ inline CellCorner lowest_cell(const BulkView& g, CellCorner fine_min, int coarser) {
  return cell_above(
      g, {lowest_corner(fine_min.x, coarser), lowest_corner(fine_min.y, coarser), lowest_corner(fine_min.z, coarser)},
      0);
}

// The finest level whose cells are at least as large as the box, and so large that rounding of the coordinates does not
// matter: at least 2^-18 of them, which is 32 units in the last place.
__device__ inline int bulk_level(const BulkView& g, const core::Box& box) {
  const core::Vec3 side = box.max - box.min;
  const float far = fmaxf(largest_magnitude(box.min), largest_magnitude(box.max)) * 0x1p-18F;
  const float needed = fmaxf(fmaxf(side.x, side.y), fmaxf(side.z, far));
  // The exponent of cell_m / needed, rounded down: how often a cell can be halved and still be as large as needed.
  const int halvings = static_cast<int>(__float_as_uint(g.cell_m) - __float_as_uint(needed)) >> 23;
  return min(max(halvings, 0), kGridLevels - 1) & -static_cast<int>(g.levels_apart);
}

// A cell of a level, counted from where the table begins.
struct TableCell {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t z = 0;
};
__device__ inline TableCell table_cell(const BulkView& g, CellCorner c, int level) {
  const auto from = [](int cell, int first, std::uint32_t halvings) {
    return static_cast<std::uint32_t>(cell) - (static_cast<std::uint32_t>(first) << halvings);
  };
  const auto halvings = static_cast<std::uint32_t>(level);
  return {from(c.x, g.first_cell[0], halvings + g.x_halvings), from(c.y, g.first_cell[1], halvings),
          from(c.z, g.first_cell[2], halvings)};
}

__device__ inline std::uint32_t row_mask(const BulkView& g) {
  return (1U << g.row_bits) - 1U;
}
// The lowest bits are a row of 2^row_bits cells, then rows follow each other in y, then in z, then slabs in x. If the
// table has a bucket for every cell of the world, that is all.
__device__ inline std::uint32_t bucket_in_block(const BulkView& g, TableCell c) {
  const std::uint32_t low = (1U << g.axis_bits) - 1U;
  const std::uint32_t slab = (c.x & ((1U << g.x_bits) - 1U)) >> g.row_bits;
  return (c.x & row_mask(g)) | (((slab << g.axis_bits | (c.z & low)) << g.axis_bits | (c.y & low)) << g.row_bits);
}
// The higher bits of the cell's numbers, and the level, are hashed, and scatter whole blocks over the table. Combine
// the result with bucket_in_block() by exclusive or.
__device__ inline std::uint32_t block_of(const BulkView& g, TableCell c, int level) {
  const std::uint32_t x = c.x >> g.x_bits;
  const std::uint32_t y = c.y >> g.axis_bits;
  const std::uint32_t z = c.z >> g.axis_bits;
  if ((x | y | z | static_cast<std::uint32_t>(level)) == 0) return 0;
  std::uint32_t far =
      x * 0x9E3779B1U ^ y * 0x85EBCA6BU ^ z * 0xC2B2AE35U ^ static_cast<std::uint32_t>(level) * 0x27D4EB2FU;
  far = (far ^ far >> 15) * 0x2C1B3C6DU;
  return ((far ^ far >> 16) << g.row_bits) & g.bucket_mask;
}
__device__ inline std::uint32_t bucket_of(const BulkView& g, TableCell c, int level) {
  return bucket_in_block(g, c) ^ block_of(g, c, level);
}

__device__ inline TableCell own_cell(const BulkView& g, const core::Box& box, int level) {
  return table_cell(g, cell_above(g, fine_corner(box.min, scaled(g.cells_per_m, level)), 0), level);
}

// Which levels have boxes, and which of them are wide: they have more blocks on an axis than a tag can tell apart.
// Cells that a box looks at are at most two away from cells with boxes, or eight if cells are a quarter as long in x:
// less than a row.
constexpr int kBlockTagBits = 9;
constexpr std::uint32_t kBlockTag = (1U << kBlockTagBits) - 1U;

struct LevelMarks {
  std::uint32_t occupied = 0;
  std::uint32_t wide = 0;

  __device__ void add(const BulkView& g, TableCell c, int level) {
    occupied |= 1U << level;
    if (max(c.x >> g.x_bits, max(c.y, c.z) >> g.axis_bits) >= kBlockTag) wide |= 1U << level;
  }
  __device__ void note(const BulkView& g) const {
    const volatile std::uint32_t* known = g.levels;
    if ((occupied & ~known[0]) != 0) atomicOr(&g.levels[0], occupied);
    if ((wide & ~known[1]) != 0) atomicOr(&g.levels[1], wide);
  }
};

// The tag of an entry: 9 bits of its block on each axis, half its level, and the static mark. If the level is not wide,
// a tag and a bucket together say which cell it is.
constexpr int kLevelTagShift = 3 * kBlockTagBits;
constexpr std::uint32_t kRowTag = ~kStaticTag;
constexpr std::uint32_t kNoCellTag = 15U << kLevelTagShift;  // of no level

__device__ inline std::uint32_t block_tag(const BulkView& g, TableCell c, int level) {
  return (c.x >> g.x_bits & kBlockTag) | (c.y >> g.axis_bits & kBlockTag) << kBlockTagBits |
         (c.z >> g.axis_bits & kBlockTag) << 2 * kBlockTagBits |
         static_cast<std::uint32_t>(level) / 2 << kLevelTagShift;
}
__device__ inline int bulk_level_of_tag(std::uint32_t tag) {
  return static_cast<int>(tag >> kLevelTagShift & 15U) * 2;
}

// A box in two words, in 128ths of a cell modulo eight cells. For boxes of neighboring cells that is mostly enough to
// tell whether they overlap. A field has 10 bits: x from bit 0, y from 11, z from 22. All coordinates are rounded by
// one monotone function, so boxes that overlap also overlap in these words. When one word is subtracted from another,
// each field's highest bit says whether the difference, which is less than four cells either way, is negative. `max`
// has a bit set above x and y, so that no field borrows from the next.
constexpr std::uint32_t kCoarseSigns = 1U << 9 | 1U << 20 | 1U << 31;
constexpr std::uint32_t kCoarseGuards = 1U << 10 | 1U << 21;

__device__ inline std::uint32_t coarse_corner(CellCorner fine, int coarser) {
  const int shift = kFineBits - 7 + coarser;
  const auto field = [shift](int v) { return static_cast<std::uint32_t>(v >> shift) & 1023U; };
  return field(fine.x) | field(fine.y) << 11 | field(fine.z) << 22;
}
__device__ inline CoarseBox coarse_box(CellCorner fine_min, CellCorner fine_max, int coarser) {
  return {coarse_corner(fine_min, coarser), coarse_corner(fine_max, coarser) | kCoarseGuards};
}
__device__ inline bool may_overlap(CoarseBox a, CoarseBox b) {
  return (((b.max - a.min) | (a.max - b.min)) & kCoarseSigns) == 0;
}
// For boxes that may overlap. If a rounded coordinate is less than another, the exact one is too, so rounding never
// accepts a false pair.
__device__ inline bool surely_overlap(CoarseBox a, CoarseBox b) {
  constexpr std::uint32_t kOnes = 1U | 1U << 11 | 1U << 22;
  return (((b.max - (a.min + kOnes)) | (a.max - kOnes - b.min)) & kCoarseSigns) == 0;
}

// The entry of a box, and where it goes.
struct BulkPlace {
  BulkEntry entry;
  std::uint32_t bucket = 0;
  TableCell cell;
  int level = 0;
};
__device__ inline BulkPlace place_of(const BulkView& g, const PackedBox& box, std::uint32_t body) {
  BulkPlace place;
  place.level = bulk_level(g, unpack(box));
  const float cells_per_m = scaled(g.cells_per_m, place.level);
  const CellCorner fine_min = fine_corner(box.min, cells_per_m);
  place.cell = table_cell(g, cell_above(g, fine_min, 0), place.level);
  place.bucket = bucket_of(g, place.cell, place.level);
  place.entry = {coarse_box(fine_min, fine_corner(box.max, cells_per_m), 0), body,
                 block_tag(g, place.cell, place.level) | (box.high_tag != 0 ? kStaticTag : 0U)};
  return place;
}

}  // namespace broadside::gpu

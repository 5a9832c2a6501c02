// Marks the coarse cells that standing boxes reach into, and finds out whether a moving box reaches into a marked cell.
//
// Corners become cells by one monotone function, so boxes that overlap share a cell, however the function rounds.
#pragma once

#include "gpu/broad/cross_view.hpp"
#include "gpu/stages/broad/grid_stage.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// This many cells that follow each other in x are the bits of a word.
constexpr int kCellsOfWord = 32;
// A moving box that reaches over more cells than this along an axis is not looked up: it counts as near.
constexpr int kMostCellsLookedAt = 4;

__device__ inline int standing_cell(float v, float cells_per_m) {
  return floor_to_int(fminf(fmaxf(v * cells_per_m, -kFarthestCell), kFarthestCell));
}

__device__ inline std::uint32_t word_of(const StandingCells& cells, int word_x, int y, int z) {
  std::uint32_t h = static_cast<std::uint32_t>(word_x) * 0x9E3779B1U ^ static_cast<std::uint32_t>(y) * 0x85EBCA6BU ^
                    static_cast<std::uint32_t>(z) * 0xC2B2AE35U;
  h = (h ^ h >> 15) * 0x2C1B3C6DU;
  return (h ^ h >> 16) & cells.word_mask;
}

// The bits of cells `from` to `to` in the word that begins at cell `begin`.
__device__ inline std::uint32_t bits_between(int begin, int from, int to) {
  const int low = max(from - begin, 0);
  const int high = min(to - begin, kCellsOfWord - 1);
  return (0xFFFFFFFFU << low) & (0xFFFFFFFFU >> (kCellsOfWord - 1 - high));
}

struct StandingRange {
  int low[3];
  int high[3];
};
__device__ inline StandingRange standing_range(const StandingCells& cells, const PackedBox& box) {
  StandingRange range;
  for (int k = 0; k < 3; ++k) {
    range.low[k] = standing_cell(box.min[k], cells.cells_per_m);
    range.high[k] = standing_cell(box.max[k], cells.cells_per_m);
  }
  return range;
}

__device__ inline void run_mark(const MarkView& view) {
  const GridPlaces grid;
  for (std::uint64_t i = grid.rank(); i < view.count; i += grid.size()) {
    const StandingRange r = standing_range(view.cells, view.boxes[i]);
    for (int z = r.low[2]; z <= r.high[2]; ++z)
      for (int y = r.low[1]; y <= r.high[1]; ++y)
        for (int x = r.low[0] & ~(kCellsOfWord - 1); x <= r.high[0]; x += kCellsOfWord) {
          std::uint32_t* const word = &view.cells.words[word_of(view.cells, x / kCellsOfWord, y, z)];
          const std::uint32_t bits = bits_between(x, r.low[0], r.high[0]);
          if ((bits & ~*static_cast<volatile std::uint32_t*>(word)) != 0) atomicOr(word, bits);
        }
  }
}

__device__ inline bool may_have_standing(const StandingCells& cells, const PackedBox& box) {
  if (!core::overlaps(unpack(box), cells.bounds)) return false;
  if (cells.words == nullptr) return true;
  const StandingRange r = standing_range(cells, box);
  for (int k = 0; k < 3; ++k)
    if (r.high[k] - r.low[k] >= kMostCellsLookedAt) return true;
  std::uint32_t found = 0;
  for (int z = r.low[2]; z <= r.high[2]; ++z)
    for (int y = r.low[1]; y <= r.high[1]; ++y)
      for (int x = r.low[0] & ~(kCellsOfWord - 1); x <= r.high[0]; x += kCellsOfWord)
        found |= cells.words[word_of(cells, x / kCellsOfWord, y, z)] & bits_between(x, r.low[0], r.high[0]);
  return found != 0;
}

}  // namespace broadside::gpu

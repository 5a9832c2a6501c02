// The published start: the first level by brute force, over tiles of bodies. METHOD section 2.
#pragma once

#include "core/method/levels.hpp"
#include "core/method/scene_octree.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/confirm_stage.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// The tile (row, column) with row <= column of the t-th place along rows of a triangle with `side` tiles a side.
struct Tile {
  std::uint32_t row = 0;
  std::uint32_t column = 0;
};

__device__ inline Tile tile_at(std::uint64_t t, std::uint32_t side) {
  // Tiles before row r: r side - r (r - 1) / 2. The root is within one of the answer; the loops settle it.
  const double b = 2.0 * side + 1.0;
  std::uint64_t row = static_cast<std::uint64_t>((b - sqrt(b * b - 8.0 * static_cast<double>(t))) * 0.5);
  const auto before = [side](std::uint64_t r) { return r * side - r * (r - (r == 0 ? 0 : 1)) / 2; };
  while (row > 0 && before(row) > t) --row;
  while (before(row + 1) <= t) ++row;
  return {static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(row + (t - before(row)))};
}

// P-Alg 2 as printed (E2).
__device__ inline bool are_in_same_node(const FrameView& f, const PackedBox& a, const PackedBox& b) {
  const core::SceneGrid grid = core::make_scene_grid(f.domain, core::kSceneOctreeDepth);
  return core::scene_node(grid, unpack(a)) == core::scene_node(grid, unpack(b));
}

// Level 0: a warp per tile of 32 x 32 bodies. Each lane holds one column's box and meets the 32 rows.
template <typename Team>
__device__ void find_pairs_by_tiles(const Team& team, const FrameView& f) {
  const std::uint32_t side = (f.body_count + 31) / 32;
  const std::uint64_t tiles = std::uint64_t{side} * (side + 1) / 2;
  for (std::uint64_t t = warp_rank(team); t < tiles; t += warp_count(team)) {
    const Tile tile = tile_at(t, side);
    const std::uint32_t j = tile.column * 32 + lane();
    const std::uint32_t first = tile.row * 32;
    const std::uint32_t last = min(first + 32, f.body_count);
    PackedBox mine = pack(core::empty_box());
    if (j < f.body_count) mine = f.boxes[j];
    unsigned hits = 0;
#pragma unroll 4
    for (std::uint32_t i = first; i < last; ++i) {
      const PackedBox other = f.boxes[i];
      const bool hit = i < j && core::overlaps(unpack(other), unpack(mine)) && (other.high_tag & mine.high_tag) == 0 &&
                       (f.start != Start::kSameNode || are_in_same_node(f, other, mine));
      hits |= (hit ? 1U : 0U) << (i - first);
    }
    unsigned long long place = warp_append(__popc(hits), &f.counters->pairs);
    for (; hits != 0; hits &= hits - 1, ++place)
      if (place < f.pairs.capacity) f.pairs.items[place] = {first + static_cast<std::uint32_t>(__ffs(hits)) - 1, j};
  }
}

// Levels level1, A and B: a warp meets all boxes of the level of body i with those of four bodies j.
template <typename Team>
__device__ void confirm_by_brute_force(const Team& team, const FrameView& f) {
  constexpr std::uint32_t kChunk = 4;
  const std::uint64_t chunks_a_row = (f.body_count + kChunk - 1) / kChunk;
  const std::uint64_t items = chunks_a_row * f.body_count;
  for (std::uint64_t item = warp_rank(team); item < items; item += warp_count(team)) {
    const auto i = static_cast<std::uint32_t>(item / chunks_a_row);
    const auto first = static_cast<std::uint32_t>(item % chunks_a_row) * kChunk;
    if (first + kChunk <= i + 1) continue;
    const std::uint32_t last = min(first + kChunk, f.body_count);
    unsigned hits = 0;
    for (std::uint32_t j = max(first, i + 1); j < last; ++j) {
      if (is_static(f, i) && is_static(f, j)) continue;
      if (are_levels_overlapping(f, i, j)) hits |= 1U << (j - first);
    }
    if (hits == 0) continue;
    const unsigned long long place = warp_append(lane() < kChunk ? (hits >> lane()) & 1U : 0U, &f.counters->confirmed);
    if (lane() < kChunk && ((hits >> lane()) & 1U) != 0 && place < f.confirmed.capacity)
      f.confirmed.items[place] = {i, first + lane()};
  }
}

}  // namespace broadside::gpu

// Tests all pairs in tiles of bodies: for the published start, and for the candidates of the published octree. METHOD
// section 2.
#pragma once

#include "core/method/levels.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/body_stage.cuh"
#include "gpu/stages/broad/body_ring.cuh"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/levels/confirm_stage.cuh"

namespace broadside::gpu {

// The t-th tile, row by row, of a triangle of tiles (row, column) with row <= column and `side` tiles a side.
struct Tile {
  std::uint32_t row = 0;
  std::uint32_t column = 0;
};

__device__ inline Tile tile_at(std::uint64_t t, std::uint32_t side) {
  // Before row r there are r side - r (r - 1) / 2 tiles. The rounded root is within one of the answer; the loops
  // correct it.
  const double b = 2.0 * side + 1.0;
  std::uint64_t row = static_cast<std::uint64_t>((b - sqrt(b * b - 8.0 * static_cast<double>(t))) * 0.5);
  const auto before = [side](std::uint64_t r) { return r * side - r * (r - (r == 0 ? 0 : 1)) / 2; };
  while (row > 0 && before(row) > t) --row;
  while (before(row + 1) <= t) ++row;
  return {static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(row + (t - before(row)))};
}

// A warp per tile of 32 x 32 bodies of `boxes`, whose low tags name them: each lane tests one column's box against the
// 32 rows. `range_end`: a row is tested only against the columns before its own end; null: against all.
template <typename Team, typename Work>
__device__ void find_pairs_by_tiles(const Team& team, const PackedBox* boxes, std::uint32_t count,
                                    const std::uint32_t* range_end, AppendView<core::Pair> out,
                                    unsigned long long* demanded, Work& work) {
  const std::uint32_t side = (count + 31) / 32;
  const std::uint64_t tiles = std::uint64_t{side} * (side + 1) / 2;
  for (std::uint64_t t = warp_rank(team); t < tiles; t += warp_count(team)) {
    const Tile tile = tile_at(t, side);
    const std::uint32_t j = tile.column * 32 + lane();
    const std::uint32_t first = tile.row * 32;
    const std::uint32_t last = min(first + 32, count);
    if (range_end != nullptr) {
      const std::uint32_t end = first + lane() < last ? range_end[first + lane()] : 0U;
      if (!__any_sync(kFullWarp, end > tile.column * 32)) continue;
    }
    PackedBox mine = pack(core::empty_box());
    if (j < count) mine = boxes[j];
    unsigned hits = 0;
#pragma unroll 4
    for (std::uint32_t i = first; i < last; ++i) {
      const PackedBox other = boxes[i];
      work.tests(i < j && j < count ? 1U : 0U);
      const bool hit = i < j && core::overlaps(unpack(other), unpack(mine)) && (other.high_tag & mine.high_tag) == 0 &&
                       (range_end == nullptr || j < range_end[i]);
      hits |= (hit ? 1U : 0U) << (i - first);
    }
    unsigned long long place = warp_append(__popc(hits), demanded);
    for (; hits != 0; hits &= hits - 1, ++place) {
      const std::uint32_t row = first + static_cast<std::uint32_t>(__ffs(hits)) - 1;
      if (place < out.capacity) out.items[place] = core::make_pair_of(boxes[row].low_tag, mine.low_tag);
    }
  }
}

// For the levels level1, A and B: a warp tests all boxes that a body has on the level against those of four other
// bodies.
template <typename Team, typename Work>
__device__ void confirm_by_brute_force(const Team& team, const FrameView& f, Work& work) {
  constexpr std::uint32_t kShare = 4;
  const BodyRing<IntegerDivisor> ring(f.body_count, kShare, IntegerDivisor(ring_shares(f.body_count, kShare)));
  for (std::uint64_t item = warp_rank(team); item < ring.items(); item += warp_count(team)) {
    const BodyRing<IntegerDivisor>::RingPair own = ring.pair_of(item);
    const core::Pair pair = core::make_pair_of(own.i, own.j);
    unsigned left = __ballot_sync(kFullWarp, own.exists && !(is_static(f, own.i) && is_static(f, own.j)));
    unsigned hits = 0;
    for (; left != 0; left &= left - 1) {
      const int source = __ffs(static_cast<int>(left)) - 1;
      const core::Pair found{__shfl_sync(kFullWarp, pair.i, source), __shfl_sync(kFullWarp, pair.j, source)};
      if (are_levels_overlapping(f, found, work)) hits |= 1U << source;
    }
    if (hits == 0) continue;
    const bool mine = (hits >> lane() & 1U) != 0;
    const unsigned long long place = warp_append(mine ? 1U : 0U, &f.counters->confirmed);
    if (mine && place < f.confirmed.capacity) f.confirmed.items[place] = pair;
  }
}

}  // namespace broadside::gpu

// All pairs of a few bodies: level 0 and the levels below it at once, without a barrier between them. METHOD section 2.
#pragma once

#include "core/method/levels.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/confirm_stage.cuh"
#include "gpu/stages/pair_queue.cuh"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

// Above this the tiles of tile_stage.cuh are sooner done: a warp of theirs tests 1024 pairs, one of ours 32.
constexpr std::uint32_t kFewBodies = 512;

// Whether frames are those of the kernel for few bodies, which knows nothing else and has a thread for each.
inline bool has_few_bodies(const FrameView& f, std::uint64_t threads) {
  return f.broad.start == Start::kTiles && f.body_count <= kFewBodies && f.body_count <= threads &&
         f.solver == Solver::kColored;
}

// The octrees of all shapes in the block's shared memory, if there is room: what is fetched while bodies are integrated
// need not be waited for when pairs go down the levels. They are there after wait_for_copies and a barrier.
__device__ inline const PackedBox* fetch_octrees(const FrameView& f, unsigned char* shared) {
  const std::uint32_t words = f.shapes.count * core::kBodyOctreeNodes * (sizeof(PackedBox) / sizeof(uint4));
  if (f.levels == core::Levels::kFlat || words * sizeof(uint4) > blockDim.x / 32 * sizeof(PairQueue))
    return f.shapes.octree;
  auto* to = reinterpret_cast<uint4*>(shared);
  const auto* from = reinterpret_cast<const uint4*>(f.shapes.octree);
  for (std::uint32_t w = threadIdx.x; w < words; w += blockDim.x) start_copy(to + w, from + w);
  return reinterpret_cast<const PackedBox*>(shared);
}

// Bodies on a ring: body i meets those 1 to n / 2 places on, so that every pair is met once without a root or a
// triangle. A warp takes some places on from one body, a lane each: as few as the warps there are allow, so that
// seldom two of its pairs go down the levels one after the other.
__device__ inline void find_and_confirm_few(const GridTeam& team, const FrameView& f, const PackedBox* octrees) {
  Uncounted work;
  const std::uint32_t count = f.body_count;
  const std::uint32_t half = count / 2;
  const std::uint64_t warps = warp_count(team);
  std::uint32_t share = 1;
  while (share < 32 && std::uint64_t{count} * ((half + share - 1) / share) > warps) share *= 2;
  const std::uint32_t shares = (half + share - 1) / share;
  const std::uint32_t items = count * shares;
  const auto stride = static_cast<std::uint32_t>(warps);
  for (auto item = static_cast<std::uint32_t>(team.spread_rank() / 32); item < items; item += stride) {
    const std::uint32_t i = item / shares;
    const std::uint32_t on = item % shares * share + lane() + 1;
    // Bodies that face each other on an even ring meet once.
    const bool has_pair = lane() < share && on <= half && (on * 2 != count || i < half);
    const std::uint32_t j = has_pair ? (i + on < count ? i + on : i + on - count) : i;
    // Everything is asked for before any of it is looked at: one wait.
    const PackedBox box_i = f.boxes[i];
    const PackedBox box_j = f.boxes[j];
    const PlacedShape placed_i = placed_shape(f, octrees, i);
    const PlacedShape placed_j = placed_shape(f, octrees, j);
    const bool overlaps =
        has_pair && core::overlaps(unpack(box_i), unpack(box_j)) && (box_i.high_tag & box_j.high_tag) == 0;
    const unsigned found = __ballot_sync(kFullWarp, overlaps);
    if (found == 0) continue;
    unsigned confirmed = 0;
    if (f.levels != core::Levels::kFlat) {
      for (unsigned left = found; left != 0; left &= left - 1) {
        const int source = __ffs(left) - 1;
        PlacedShape other;
        other.shape = __shfl_sync(kFullWarp, placed_j.shape, source);
        other.octree = octrees + std::uint64_t{other.shape} * core::kBodyOctreeNodes;
        other.x = {__shfl_sync(kFullWarp, placed_j.x.x, source), __shfl_sync(kFullWarp, placed_j.x.y, source),
                   __shfl_sync(kFullWarp, placed_j.x.z, source)};
        if (are_levels_overlapping<2>(f, placed_i, other, work)) confirmed |= 1U << source;
      }
    }
    // Lane 0 takes room for the pairs, lane 1 for what is confirmed: one wait.
    unsigned long long base = 0;
    if (lane() < 2)
      base = atomicAdd(lane() == 0 ? &f.counters->pairs : &f.counters->confirmed,
                       static_cast<unsigned long long>(__popc(lane() == 0 ? found : confirmed)));
    const unsigned long long first_pair = __shfl_sync(kFullWarp, base, 0);
    const unsigned long long first_confirmed = __shfl_sync(kFullWarp, base, 1);
    const core::Pair pair = core::make_pair_of(i, j);
    const auto enter = [&](unsigned lanes, unsigned long long first, const AppendView<core::Pair>& out) {
      const unsigned long long place = first + __popc(lanes & ((1U << lane()) - 1U));
      if ((lanes >> lane() & 1U) != 0 && place < out.capacity) out.items[place] = pair;
    };
    enter(found, first_pair, f.pairs);
    enter(confirmed, first_confirmed, f.confirmed);
  }
}

}  // namespace broadside::gpu

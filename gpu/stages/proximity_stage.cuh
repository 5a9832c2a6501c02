// Nearest vertices of each confirmed pair, P(7) and P(8): how pairs are dealt out to warps.
#pragma once

#include "core/method/proximity.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/cell_search.cuh"
#include "gpu/stages/search_stack.cuh"
#include "gpu/stages/team.cuh"
#include "gpu/stages/tree_search.cuh"

namespace broadside::gpu {

constexpr std::uint32_t kMaxBlockWarps = 16;  // so that each of their teams has a barrier

// Shared memory of a block: what the warps of one pair share.
struct ProximityScratch {
  std::uint32_t bound[kMaxBlockWarps];
  TeamCounts counts[kMaxBlockWarps][2];
  core::Proximity part[kMaxBlockWarps];
};

// Of so many warps side by side.
__device__ inline SearchStack stack_of_warps(const FrameView& f, void* stacks, std::uint32_t first,
                                             std::uint32_t count) {
  const std::uint32_t each = f.stack_entries;
  return {static_cast<std::uint32_t*>(stacks) + std::uint64_t{first} * each * 3, count * each, count * each};
}

// A warp a pair. Pairs take very unequal times, so a warp takes new ones when it is done with its own; several at once
// where there are very many, because all warps take from one counter.
__device__ inline void measure_by_warps(const FrameView& f, std::uint64_t count, ProximityScratch& scratch,
                                        void* stacks) {
  const std::uint64_t warps = std::uint64_t{gridDim.x} * (blockDim.x / 32);
  const std::uint64_t share = max(std::uint64_t{1}, min(std::uint64_t{8}, count / (warps * 32)));
  std::uint32_t* bound = &scratch.bound[threadIdx.x / 32];
  const SearchStack stack = stack_of_warps(f, stacks, threadIdx.x / 32, 1);
  for (;;) {
    unsigned long long first = 0;
    if (lane() == 0) first = atomicAdd(&f.counters->measured, static_cast<unsigned long long>(share));
    first = __shfl_sync(kFullWarp, first, 0);
    if (first >= count) return;
    for (std::uint64_t k = first; k < min(std::uint64_t{first} + share, count); ++k) {
      if (lane() == 0) *bound = __float_as_uint(INFINITY);
      __syncwarp();
      const core::Pair pair = f.confirmed.items[k];
      const CellRoles roles = cell_roles(f, pair);
      const core::Proximity best = roles.has_cells
                                       ? NearestByCells(f, pair, roles.is_asked_by_j, stack, bound, 0, 1).find()
                                       : nearest_by_trees(TreePair(f, pair, bound), stack);
      if (lane() == 0) f.proximity[k] = best;
      __syncwarp();
    }
  }
}

// When there are fewer pairs than warps, several warps of a block share a pair. The block's warps are a power of two.
__device__ inline void measure_proximity(const FrameView& f, std::uint64_t count, ProximityScratch& scratch,
                                         void* stacks) {
  const std::uint32_t warps = blockDim.x / 32;
  const std::uint32_t warp = threadIdx.x / 32;
  std::uint32_t members = 1;
  while (members < warps && count * members * 2 <= std::uint64_t{gridDim.x} * warps) members *= 2;
  if (members == 1) return measure_by_warps(f, count, scratch, stacks);
  const std::uint32_t teams = warps / members;
  const std::uint32_t team = warp / members;
  const std::uint32_t member = warp % members;
  const SearchStack own_stack = stack_of_warps(f, stacks, warp, 1);
  const SearchTeam search{member, members, team, stack_of_warps(f, stacks, team * members, members),
                          scratch.counts[team]};

  // The same number of turns for every warp of the block, because they meet at its barrier.
  for (std::uint64_t base = 0; base < count; base += std::uint64_t{teams} * gridDim.x) {
    const std::uint64_t k = base + std::uint64_t{team} * gridDim.x + blockIdx.x;
    std::uint32_t* bound = &scratch.bound[team];
    if (member == 0 && lane() == 0) *bound = __float_as_uint(INFINITY);
    __syncthreads();
    core::Proximity best;
    if (k < count) {
      const core::Pair pair = f.confirmed.items[k];
      const CellRoles roles = cell_roles(f, pair);
      best = roles.has_cells ? NearestByCells(f, pair, roles.is_asked_by_j, own_stack, bound, member, members).find()
                             : nearest_by_trees(TreePair(f, pair, bound), search);
    }
    if (lane() == 0) scratch.part[warp] = best;
    __syncthreads();
    for (std::uint32_t m = 1; member == 0 && m < members; ++m)
      if (core::is_nearer(scratch.part[warp + m], best)) best = scratch.part[warp + m];
    if (member == 0 && lane() == 0 && k < count) f.proximity[k] = best;
  }
}

}  // namespace broadside::gpu

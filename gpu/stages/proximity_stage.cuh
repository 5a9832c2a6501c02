// Nearest vertices of each pair, P(7) and P(8): how pairs are dealt out to warps.
#pragma once

#include "core/method/proximity.hpp"
#include "gpu/frame_view.hpp"
#include "gpu/stages/cell_search.cuh"
#include "gpu/stages/meeting_pairs.cuh"
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

// Where nothing is ever left to be found out about pairs but how near they are; otherwise FewLevels.
struct NoLevels {
  __device__ void begin() const {}
  __device__ void end() const {}
  __device__ static bool look(core::Pair /*pair*/, std::uint64_t /*k*/) { return true; }
  __device__ static std::uint32_t ask(bool /*asks*/, std::uint64_t /*k*/) { return 0; }
};

template <typename Levels>
class ProximityStage {
 public:
  __device__ ProximityStage(const FrameView& f, const ShapeHeaders& headers, const Levels& levels,
                            const MeetingPairs& pairs, ProximityScratch& scratch, void* stacks)
      : f_(f), headers_(headers), levels_(levels), pairs_(pairs), scratch_(scratch), stacks_(stacks) {}

  // When there are fewer pairs than warps, several warps of a block share a pair, and where levels are left so many
  // warps remain that there is one for each pair's. The block's warps are a power of two.
  __device__ void run() const {
    if (pairs_.are_levels_left) levels_.begin();
    const std::uint32_t warps = blockDim.x / 32;
    const std::uint32_t all_warps = gridDim.x * warps;
    const auto count = static_cast<std::uint32_t>(min(pairs_.count, std::uint64_t{all_warps}));
    const std::uint32_t besides = pairs_.are_levels_left ? count : 0;
    std::uint32_t members = 1;
    while (members < warps && count * members * 2 + besides <= all_warps) members *= 2;
    if (members == 1)
      measure_by_warps();
    else
      measure_by_teams(members);
    if (pairs_.are_levels_left) levels_.end();
  }

 private:
  // A warp a pair. Pairs take very unequal times, so a warp takes new ones when it is done with its own; several at
  // once where there are very many, because all warps take from one counter.
  __device__ void measure_by_warps() const {
    if (pairs_.are_levels_left) __syncthreads();
    const std::uint64_t warps = std::uint64_t{gridDim.x} * (blockDim.x / 32);
    const std::uint64_t share = max(std::uint64_t{1}, min(std::uint64_t{8}, pairs_.count / (warps * 32)));
    std::uint32_t* bound = &scratch_.bound[threadIdx.x / 32];
    const SearchStack stack = stack_of_warps(f_, stacks_, threadIdx.x / 32, 1);
    for (;;) {
      unsigned long long first = 0;
      if (lane() == 0) first = atomicAdd(&f_.counters->measured, static_cast<unsigned long long>(share));
      first = __shfl_sync(kFullWarp, first, 0);
      if (first >= pairs_.count) return;
      for (std::uint64_t k = first; k < min(std::uint64_t{first} + share, pairs_.count); ++k) {
        if (lane() == 0) *bound = __float_as_uint(INFINITY);
        __syncwarp();
        const core::Pair pair = pairs_.items[k];
        if (pairs_.are_levels_left && !levels_.look(pair, k)) continue;
        const CellRoles roles = cell_roles(f_, headers_, pair);
        tell(k, warp_nearest(roles.has_cells
                                 ? NearestByCells(f_, headers_, pair, roles.is_asked_by_j, stack, bound, {}).find()
                                 : nearest_by_trees(TreePair(f_, headers_, pair, bound), stack)));
        __syncwarp();
      }
    }
  }

  // There are as many teams as pairs, or more. Where levels are left, the warps of those that have no pair see to them.
  __device__ void measure_by_teams(std::uint32_t members) const {
    const std::uint32_t warp = threadIdx.x / 32;
    const std::uint32_t team = warp / members;
    const WarpShare share{warp % members, members};
    const std::uint64_t k = std::uint64_t{team} * gridDim.x + blockIdx.x;
    if (lane() == 0) scratch_.bound[warp] = __float_as_uint(INFINITY);
    __syncthreads();
    core::Proximity best;
    if (k < pairs_.count) {
      const core::Pair pair = pairs_.items[k];
      const CellRoles roles = cell_roles(f_, headers_, pair);
      best = warp_nearest(roles.has_cells ? nearest_by_cells(pair, roles.is_asked_by_j, team, share)
                                          : nearest_by_team(pair, k, team, share));
    } else if (pairs_.are_levels_left) {
      const std::uint64_t idle = std::uint64_t{gridDim.x} * (blockDim.x / 32 / members) - pairs_.count;
      const std::uint64_t other = share.member * idle + (k - pairs_.count);
      if (other < pairs_.count) levels_.look(pairs_.items[other], other);
    }
    if (lane() == 0) scratch_.part[warp] = best;
    __syncthreads();
    if (share.member != 0 || k >= pairs_.count) return;
    best = warp_nearest(lane() < members ? scratch_.part[warp + lane()] : core::Proximity{});
    tell(k, best);
  }

  // These two return each lane's nearest.
  __device__ core::Proximity nearest_by_cells(core::Pair pair, bool is_asked_by_j, std::uint32_t team,
                                              const WarpShare& share) const {
    return NearestByCells(f_, headers_, pair, is_asked_by_j, stack_of_warps(f_, stacks_, threadIdx.x / 32, 1),
                          &scratch_.bound[team], share)
        .find();
  }
  __device__ core::Proximity nearest_by_team(core::Pair pair, std::uint64_t k, std::uint32_t team,
                                             const WarpShare& share) const {
    const std::uint32_t first = team * share.members;
    const SearchTeam all{share, team, stack_of_warps(f_, stacks_, first, share.members), scratch_.counts[team]};
    return nearest_by_trees(TreePair(f_, headers_, pair, &scratch_.bound[team]), all,
                            [&](bool asks) { return levels_.ask(asks && pairs_.are_levels_left, k); });
  }

  __device__ void tell(std::uint64_t k, const core::Proximity& p) const {
    if (lane() == 0) pairs_.measured(f_, k, p);
  }

  const FrameView& f_;
  ShapeHeaders headers_;
  const Levels& levels_;
  const MeetingPairs& pairs_;
  ProximityScratch& scratch_;
  void* stacks_;
};

}  // namespace broadside::gpu

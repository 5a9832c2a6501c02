// Finds the nearest vertices of each pair, P(7) and P(8): this file deals pairs out to warps.
#pragma once

#include "core/method/proximity.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/grid/team.cuh"
#include "gpu/stages/vertices/cell_search.cuh"
#include "gpu/stages/vertices/leftover_work.cuh"
#include "gpu/stages/vertices/narrow_pairs.cuh"
#include "gpu/stages/vertices/search_stack.cuh"
#include "gpu/stages/vertices/tree_search.cuh"
#include "gpu/stages/vertices/tree_start.cuh"

namespace broadside::gpu {

constexpr std::uint32_t kMaxBlockWarps = 16;  // so that each team has a barrier of its own

// What the warps of one pair share, in the block's shared memory.
struct ProximityScratch {
  static constexpr unsigned long long kNoVertices = ~0ULL;

  std::uint32_t bound[kMaxBlockWarps];
  unsigned long long nearest[kMaxBlockWarps];
  TeamCounts counts[kMaxBlockWarps][kTeamTurns];
  std::uint32_t place[kMaxBlockWarps];

  // Called by all threads. A barrier of the block must follow before teams search.
  __device__ void clear() {
    const std::uint32_t warp = threadIdx.x / 32;
    if (lane() != 0) return;
    bound[warp] = __float_as_uint(INFINITY);
    nearest[warp] = kNoVertices;
    for (TeamCounts& turn : counts[warp]) turn = {};
  }
};

// The stacks of `count` neighboring warps, joined to one.
__device__ inline SearchStack stack_of_warps(const FrameView& f, void* stacks, std::uint32_t first,
                                             std::uint32_t count) {
  const std::uint32_t each = f.stack_entries;
  return {static_cast<std::uint32_t*>(stacks) + std::uint64_t{first} * each * 3, count * each, count * each};
}

// For frames whose levels were tested before; other frames use SmallLevels.
struct NoLevels {
  static constexpr bool kIsSmallFrame = false;
  using View = FrameView;

  __device__ void begin() const {}
  __device__ void end() const {}
  __device__ static bool look(const PlacedPair& /*bodies*/, std::uint64_t /*k*/) { return true; }
};

template <typename Levels>
class ProximityStage {
 public:
  using View = typename Levels::View;

  __device__ ProximityStage(const View& f, const ShapeHeaders& headers, const Levels& levels, const NarrowPairs& pairs,
                            ProximityScratch& scratch, void* stacks)
      : f_(f), headers_(headers), levels_(levels), pairs_(pairs), scratch_(scratch), stacks_(stacks) {}

  // If there are fewer pairs than warps, several warps of a block share a pair. If levels are left, one warp for each
  // pair is kept free to test them. The number of a block's warps is a power of two.
  __device__ void run() const {
    const std::uint32_t warps = blockDim.x / 32;
    const std::uint32_t all_warps = gridDim.x * warps;
    const auto count = static_cast<std::uint32_t>(min(pairs_.count, std::uint64_t{all_warps}));
    const std::uint32_t besides = pairs_.are_levels_left ? count : 0;
    const std::uint32_t shift = shift_of_members(count, all_warps - besides, warps);
    const std::uint32_t teams = warps >> shift;  // of a block
    // If any team of a block has no pair, the last one has none: its last warp copies the octrees that levels need.
    const bool looks = pairs_.are_levels_left && threadIdx.x / 32 == warps - 1 &&
                       (shift == 0 || (teams - 1) * gridDim.x + blockIdx.x >= pairs_.count);
    if (looks) levels_.begin();
    if (shift == 0)
      measure_by_warps();
    else
      measure_by_teams(shift);
    if (looks) levels_.end();
  }

  // In small frames: the whole grid shares the work that teams left, until no more is left. `sync`: the barrier of the
  // grid; returns SmallCounts since the frame began.
  template <typename Sync>
  __device__ void share_leftovers(const Sync& sync) const {
    std::uint32_t before = 0;
    std::uint32_t turn = 0;
    for (SmallCounts counts = sync(); counts.leftovers > before; ++turn) {
      const std::uint32_t count = min(counts.leftovers - before, most_leftovers());
      before = counts.leftovers;
      search_part(f_.leftovers[turn % 2], count, f_.leftovers[(turn + 1) % 2], before);
      counts = sync();
    }
  }

 private:
  using Cells = NearestByCells<Levels::kIsSmallFrame>;

  // How many warps a pair gets, as a power of two: as many as the warps allow for this many pairs, but at most all of a
  // block.
  __device__ static std::uint32_t shift_of_members(std::uint32_t pairs, std::uint32_t warps,
                                                   std::uint32_t block_warps) {
    if (warps < pairs) return 0;
    std::uint32_t shift = __clz(static_cast<int>(pairs)) - __clz(static_cast<int>(warps));
    if (pairs << shift > warps) --shift;
    return min(shift, 31U - __clz(static_cast<int>(block_warps)));
  }

  // A warp for each pair. Pairs take very different times, so a warp takes new pairs when it has finished its own. If
  // there are very many, it takes several at once, because all warps take them from one counter.
  __device__ void measure_by_warps() const {
    const std::uint64_t warps = std::uint64_t{gridDim.x} * (blockDim.x / 32);
    const std::uint64_t share = max(std::uint64_t{1}, min(std::uint64_t{8}, pairs_.count / (warps * 32)));
    std::uint32_t* bound = &scratch_.bound[threadIdx.x / 32];
    const SearchStack stack = stack_of_warps(f_, stacks_, threadIdx.x / 32, 1);
    for (;;) {
      unsigned long long first = 0;
      if (lane() == 0) first = atomicAdd(given_out(), static_cast<unsigned long long>(share));
      first = __shfl_sync(kFullWarp, first, 0);
      if (first >= pairs_.count) return;
      for (std::uint64_t k = first; k < min(std::uint64_t{first} + share, pairs_.count); ++k) {
        if (lane() == 0) *bound = __float_as_uint(INFINITY);
        __syncwarp();
        const PlacedPair bodies = pairs_.bodies(f_, k);
        if (pairs_.are_levels_left && !levels_.look(bodies, k)) continue;
        const CellRoles roles = cell_roles(f_, headers_, bodies);
        const core::Proximity best =
            warp_nearest(roles.has_cells ? Cells(f_, headers_, bodies, roles.is_asked_by_j, stack, bound, {}).find()
                                         : nearest_by_trees(TreePair(f_, headers_, bodies, bound), stack));
        if (lane() == 0) pairs_.tell(f_, k, best);
        __syncwarp();
      }
    }
  }

  // The counter of pairs that were given out to warps.
  __device__ unsigned long long* given_out() const {
    if constexpr (Levels::kIsSmallFrame)
      return f_.given_out;
    else
      return &f_.counters->measured;
  }

  // A team for each pair; there must be at least as many teams as pairs. If levels are left, warps of teams without a
  // pair test them.
  __device__ void measure_by_teams(std::uint32_t shift) const {
    const std::uint32_t warp = threadIdx.x / 32;
    const std::uint32_t team = warp >> shift;
    const std::uint32_t members = 1U << shift;
    const WarpShare share{warp & (members - 1), members};
    const std::uint64_t k = std::uint64_t{team} * gridDim.x + blockIdx.x;
    scratch_.clear();
    __syncthreads();
    if (k < pairs_.count) {
      const PlacedPair bodies = pairs_.bodies(f_, k);
      const CellRoles roles = cell_roles(f_, headers_, bodies);
      const core::Proximity best = roles.has_cells ? nearest_by_cells(bodies, roles.is_asked_by_j, team, share)
                                                   : nearest_by_team(bodies, k, team, share);
      tell_team(team, best);
    } else if (pairs_.are_levels_left) {
      const std::uint64_t idle = std::uint64_t{gridDim.x} * (blockDim.x / 32 >> shift) - pairs_.count;
      const std::uint64_t other = share.member * idle + (k - pairs_.count);
      if (other < pairs_.count) levels_.look(pairs_.bodies(f_, other), other);
    }
    __syncthreads();
    if (share.member == 0 && lane() == 0 && k < pairs_.count) pairs_.tell(f_, k, nearest_of_team(team));
  }

  // Searches this block's part of the work that was handed over, with all warps of the block as one team.
  __device__ void search_part(const LeftoverView& leftovers, std::uint32_t count, const LeftoverView& to,
                              std::uint32_t before) const {
    const std::uint32_t warp = threadIdx.x / 32;
    const std::uint32_t warps = blockDim.x / 32;
    const SearchTeam all{{warp, warps}, 0, stack_of_warps(f_, stacks_, 0, warps), scratch_.counts[0]};
    const LeftoverPart part(leftovers, count, all);
    const LeftoverSearch& leftover = part.leftover();
    if (threadIdx.x == 0) {
      scratch_.bound[0] = __float_as_uint(leftover.bound_m2);
      scratch_.nearest[0] = ProximityScratch::kNoVertices;
      scratch_.counts[0][1] = {};
    }
    __syncthreads();
    if (part.counts().any()) {
      LeftoverOfPair next(f_, to, before, leftover.bodies, leftover.k, kRoundsOfBlock, &scratch_.place[0]);
      tell_team(
          0, nearest_by_trees(TreePair(f_, headers_, leftover.bodies, &scratch_.bound[0]), all, part.counts(), next));
    }
    __syncthreads();
    if (threadIdx.x == 0 && scratch_.nearest[0] != ProximityScratch::kNoVertices)
      improve(f_.measured + leftover.k, nearest_of_team(0));
  }

  // Called by all lanes of a team, after a barrier that follows its search. By then the bound is the least distance,
  // and the lanes that found it store their vertices.
  __device__ void tell_team(std::uint32_t team, const core::Proximity& best) const {
    if (best.is_touching() && __float_as_uint(best.squared_distance_m2) == scratch_.bound[team])
      atomicMin(&scratch_.nearest[team], static_cast<unsigned long long>(best.vertex_a) << 32 | best.vertex_b);
  }
  // The team's result; a barrier of the block must lie between tell_team() and this.
  __device__ core::Proximity nearest_of_team(std::uint32_t team) const {
    const unsigned long long vertices = scratch_.nearest[team];
    if (vertices == ProximityScratch::kNoVertices) return {};
    return {__uint_as_float(scratch_.bound[team]), static_cast<std::uint32_t>(vertices >> 32),
            static_cast<std::uint32_t>(vertices)};
  }

  // These two return each lane's nearest vertices, after a barrier of the team.
  __device__ core::Proximity nearest_by_cells(const PlacedPair& bodies, bool is_asked_by_j, std::uint32_t team,
                                              const WarpShare& share) const {
    const core::Proximity best = Cells(f_, headers_, bodies, is_asked_by_j,
                                       stack_of_warps(f_, stacks_, threadIdx.x / 32, 1), &scratch_.bound[team], share)
                                     .find();
    sync_warps(team, share.members);
    return best;
  }
  __device__ core::Proximity nearest_by_team(const PlacedPair& bodies, std::uint64_t k, std::uint32_t team,
                                             const WarpShare& share) const {
    const SearchTeam all{share, team, stack_of_warps(f_, stacks_, team * share.members, share.members),
                         scratch_.counts[team]};
    const TreePair trees(f_, headers_, bodies, &scratch_.bound[team]);
    if (headers_.upper_copy != nullptr) headers_.upper_copy->wait();
    const TeamCounts left = TreeStart(trees, all).begin();
    if constexpr (Levels::kIsSmallFrame) {
      LeftoverOfPair leftover(f_, f_.leftovers[0], 0, bodies, k, rounds_of_team(trees), &scratch_.place[team]);
      return nearest_by_trees(trees, all, left, leftover);
    } else {
      NoLeftover leftover;
      return nearest_by_trees(trees, all, left, leftover);
    }
  }

  // After how many rounds a team hands over. A barrier of the grid costs as much as some four rounds. The more levels
  // are left to descend, the more work there may be to hand over, and the sooner it is handed over.
  __device__ static std::uint32_t rounds_of_team(const TreePair& trees) { return trees.upper_level() >= 3 ? 2 : 3; }
  static constexpr std::uint32_t kRoundsOfBlock = 8;

  const View& f_;
  ShapeHeaders headers_;
  const Levels& levels_;
  const NarrowPairs& pairs_;
  ProximityScratch& scratch_;
  void* stacks_;
};

}  // namespace broadside::gpu

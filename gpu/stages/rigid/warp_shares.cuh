// How warps share items that each take long and branch differently. Lanes of a warp that take different branches wait
// for each other.
#pragma once

#include <cstdint>

#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// How many items each warp takes at once, 32 at most: equal shares for all warps, in the fewest rounds.
__device__ inline std::uint64_t even_share(std::uint64_t items, std::uint64_t warps) {
  const std::uint64_t rounds = max((items + 32 * warps - 1) / (32 * warps), std::uint64_t{1});
  return (items + rounds * warps - 1) / (rounds * warps);
}

// Calls work(k, is_item) by whole warps, for all items; where is_item is false k is no item. is_spread: each warp gets
// as few items as possible, so that few items are spread over all warps. Not for short items: more warps then fetch the
// code, which takes longer than the wait.
template <typename Team, typename Work>
__device__ __forceinline__ void each_item_by_warps(const Team& team, std::uint64_t items, bool is_spread,
                                                   const Work& work) {
  const std::uint64_t warps = team.size() / 32;
  const std::uint64_t at_once = is_spread ? even_share(items, warps) : 32;
  for (std::uint64_t first = team.spread_rank() / 32 * at_once; first < items; first += warps * at_once) {
    const std::uint64_t k = first + lane();
    work(k, lane() < at_once && k < items);
  }
}

// The same for items that are all long; each gets a whole warp. All warps of a block begin together, so that code that
// one of them fetches is there for the others. prepare(k, is_item), called by whole warps, returns whether the lane has
// an item; then work(k, of) is called for these items in turn, with the calling lane's own k and the lane `of` that has
// the item.
template <typename Team, typename Prepare, typename Work>
__device__ __forceinline__ void each_item_in_step(const Team& team, std::uint64_t items, const Prepare& prepare,
                                                  const Work& work) {
  const std::uint64_t warps = team.size() / 32;
  const std::uint64_t at_once = even_share(items, warps);
  for (std::uint64_t round = 0; round * warps * at_once < items; ++round) {
    const std::uint64_t k = (round * warps + team.spread_rank() / 32) * at_once + lane();
    unsigned with = __ballot_sync(kFullWarp, prepare(k, lane() < at_once && k < items));
    for (; __syncthreads_or(with != 0 ? 1 : 0) != 0; with &= with - 1)
      if (with != 0) work(k, static_cast<unsigned>(__ffs(static_cast<int>(with)) - 1));
  }
}

}  // namespace broadside::gpu

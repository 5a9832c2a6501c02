// How warps share items of which each takes long, and each another way: lanes of a warp then wait for each other.
#pragma once

#include <cstdint>

#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// work(k, is_item) by whole warps for all items; k is none where is_item is false. is_spread: as few lanes of a warp as
// can be have one, so that few items are spread over all warps. Where items are short, the code that more warps then
// fetch takes longer than the wait.
template <typename Team, typename Work>
__device__ __forceinline__ void each_item_by_warps(const Team& team, std::uint64_t items, bool is_spread,
                                                   const Work& work) {
  const std::uint64_t warps = team.size() / 32;
  const std::uint64_t at_once = is_spread ? min((items + warps - 1) / warps, std::uint64_t{32}) : 32;
  for (std::uint64_t first = team.spread_rank() / 32 * at_once; first < items; first += warps * at_once) {
    const std::uint64_t k = first + lane();
    work(k, lane() < at_once && k < items);
  }
}

// The same where all items are spread and long, each a warp's: all warps of a block begin together, so that code which
// one of them fetches is there for the others. prepare(k, is_item) by whole warps: whether the lane has an item; then
// work(lane that has it) for one after the other.
template <typename Team, typename Prepare, typename Work>
__device__ __forceinline__ void each_item_in_step(const Team& team, std::uint64_t items, const Prepare& prepare,
                                                  const Work& work) {
  const std::uint64_t warps = team.size() / 32;
  const std::uint64_t at_once = min((items + warps - 1) / warps, std::uint64_t{32});
  for (std::uint64_t round = 0; round * warps * at_once < items; ++round) {
    const std::uint64_t k = (round * warps + team.spread_rank() / 32) * at_once + lane();
    unsigned with = __ballot_sync(kFullWarp, prepare(k, lane() < at_once && k < items));
    for (; __syncthreads_or(with != 0 ? 1 : 0) != 0; with &= with - 1)
      if (with != 0) work(k, static_cast<unsigned>(__ffs(static_cast<int>(with)) - 1));
  }
}

}  // namespace broadside::gpu

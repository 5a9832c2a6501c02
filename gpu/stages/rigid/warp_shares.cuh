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

}  // namespace broadside::gpu

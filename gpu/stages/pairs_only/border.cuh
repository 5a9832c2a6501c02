// Finds the boxes of a part that reach over its upper face, and adds up the digest of pairs, by kernels without
// barriers.
#pragma once

#include "gpu/broad/border_view.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// Called by whole warps.
__device__ inline void append_guest(const BorderView& view, std::uint32_t to_part, bool reaches, std::uint64_t i,
                                    const PackedBox& box) {
  const unsigned all = __ballot_sync(kFullWarp, reaches);
  if (all == 0) return;
  unsigned long long first = 0;
  if (lane() == 0) first = atomicAdd(&view.reached[to_part], static_cast<unsigned long long>(__popc(all)));
  first = __shfl_sync(kFullWarp, first, 0);
  const unsigned long long place = first + static_cast<unsigned>(__popc(all & ((1U << lane()) - 1U)));
  if (!reaches || place >= view.capacity) return;
  view.out[to_part * view.capacity + place] = box;
  if (view.given != nullptr) view.given_out[to_part * view.capacity + place] = view.given[i];
}

__device__ inline void run_borders(const BorderView& view) {
  const GridPlaces grid;
  const std::uint64_t rounds = (view.count + grid.size() - 1) / grid.size();
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::uint64_t i = round * grid.size() + grid.rank();
    PackedBox box;
    std::uint32_t last = view.part;
    if (i < view.count) {
      box = view.boxes[i];
      while (last + 1 < view.parts && view.faces[last] <= box.max[view.axis]) ++last;
      if (!view.keeps_names) box.low_tag = view.base + static_cast<std::uint32_t>(i);
    }
    for (std::uint32_t k = view.part + 1; __any_sync(kFullWarp, k <= last); ++k)
      append_guest(view, k, k <= last, i, box);
  }
}

__device__ inline void run_pair_digest(const PairDigestView& view) {
  const GridPlaces grid;
  unsigned long long sum = 0;
  for (std::uint64_t k = grid.rank(); k < view.count; k += grid.size())
    sum += core::splitmix64(core::pair_key(view.pairs[k]));
  for (unsigned step = 16; step > 0; step /= 2) sum += __shfl_xor_sync(kFullWarp, sum, step);
  if (lane() == 0 && sum != 0) atomicAdd(view.sum, sum);
}

}  // namespace broadside::gpu

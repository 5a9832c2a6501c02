// Pairs found by one warp, kept in shared memory so that the warp takes its room in the append buffer at once.
#pragma once

#include "gpu/broad_view.hpp"
#include "gpu/stages/team.cuh"

namespace broadside::gpu {

struct PairQueue {
  // A warp's 32 boxes have some 130 partners in the races' uniform boxes.
  static constexpr std::uint32_t kRoom = 255;
  std::uint32_t count;
  std::uint32_t unused;
  core::Pair pairs[kRoom];
};

__device__ inline void open_queue(PairQueue& queue) {
  if (lane() == 0) queue.count = 0;
  __syncwarp();
}

// By any lanes. What the queue has no room for goes to the buffer at once, lanes that come together sharing an atomic:
// one atomic a pair is what a crowd of boxes would wait for.
__device__ inline void push_pair(PairQueue& queue, AppendView<core::Pair> out, unsigned long long* demanded,
                                 core::Pair p) {
  const std::uint32_t place = atomicAdd(&queue.count, 1U);
  if (place < PairQueue::kRoom) {
    queue.pairs[place] = p;
    return;
  }
  const unsigned together = __activemask();
  const unsigned before = __popc(together & ((1U << lane()) - 1U));
  unsigned long long base = 0;
  const unsigned leader = static_cast<unsigned>(__ffs(together)) - 1;
  if (lane() == leader) base = atomicAdd(demanded, static_cast<unsigned long long>(__popc(together)));
#if defined(__CUDACC__)
  base = __shfl_sync(together, base, leader);
#endif
  if (base + before < out.capacity) out.items[base + before] = p;
}

// By whole warps.
__device__ inline void flush_pairs(PairQueue& queue, AppendView<core::Pair> out, unsigned long long* demanded) {
  __syncwarp();
  const std::uint32_t count = min(queue.count, PairQueue::kRoom);
  unsigned long long base = 0;
  if (lane() == 0 && count > 0) base = atomicAdd(demanded, static_cast<unsigned long long>(count));
  base = __shfl_sync(kFullWarp, base, 0);
  for (std::uint32_t k = lane(); k < count; k += 32)
    if (base + k < out.capacity) out.items[base + k] = queue.pairs[k];
  __syncwarp();
  if (lane() == 0) queue.count = 0;
  __syncwarp();
}

// Flushes only when the next round might not fit; after the last round comes flush_pairs. By whole warps.
__device__ inline void flush_if_filled(PairQueue& queue, AppendView<core::Pair> out, unsigned long long* demanded) {
  __syncwarp();
  if (__any_sync(kFullWarp, *static_cast<volatile std::uint32_t*>(&queue.count) > PairQueue::kRoom / 2))
    flush_pairs(queue, out, demanded);
}

}  // namespace broadside::gpu

// A queue in shared memory for the pairs that one warp finds. The warp reserves room in the append buffer for all of
// them together, with one atomic for some two hundred pairs.
#pragma once

#include "gpu/broad/broad_view.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

struct PairQueue {
  static constexpr std::uint32_t kRoom = 256;
  core::Pair pairs[kRoom];
};

// One warp's use of its queue. Every call is by the whole warp.
class WarpQueue {
 public:
  __device__ WarpQueue(PairQueue& room, AppendView<core::Pair> out, unsigned long long* demanded)
      : room_(room), out_(out), demanded_(demanded) {}

  __device__ void push(bool has_pair, core::Pair p) {
    const unsigned found = __ballot_sync(kFullWarp, has_pair);
    if (found == 0) return;
    if (has_pair) room_.pairs[count_ + __popc(found & ((1U << lane()) - 1U))] = p;
    count_ += static_cast<std::uint32_t>(__popc(found));
    if (count_ > PairQueue::kRoom - 32) flush();
  }

  __device__ void flush() {
    __syncwarp();
    unsigned long long base = 0;
    if (lane() == 0 && count_ > 0) base = atomicAdd(demanded_, static_cast<unsigned long long>(count_));
    write(__shfl_sync(kFullWarp, base, 0));
  }

  // Called once by each warp of a block. The block uses one atomic for all of its warps, because all warps of a grid
  // end at about the same time. `pairs` and `base` lie in the block's shared memory; `pairs` must be zero before.
  __device__ void flush_block(std::uint32_t& pairs, unsigned long long& base) {
    const std::uint32_t before = room_for_warp(count_, &pairs);
    __syncthreads();
    if (threadIdx.x == 0) base = pairs != 0 ? atomicAdd(demanded_, static_cast<unsigned long long>(pairs)) : 0;
    __syncthreads();
    write(base + before);
  }

 private:
  __device__ void write(unsigned long long base) {
    for (std::uint32_t k = lane(); k < count_; k += 32)
      if (base + k < out_.capacity) out_.items[base + k] = room_.pairs[k];
    __syncwarp();
    count_ = 0;
  }

  PairQueue& room_;
  AppendView<core::Pair> out_;
  unsigned long long* demanded_;
  std::uint32_t count_ = 0;  // the same in all lanes
};

}  // namespace broadside::gpu

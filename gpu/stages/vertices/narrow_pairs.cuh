// The pairs of the narrow phase. The vertex stage, if there is one, finds their nearest vertices; the response collects
// the pairs that touch.
#pragma once

#include "core/method/proximity.hpp"
#include "core/pair.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/frame/measured_pair.hpp"
#include "gpu/stages/grid/fetched.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// The confirmed pairs or, if levels are left, all pairs that level 0 found.
struct NarrowPairs {
  const core::Pair* items = nullptr;
  std::uint64_t count = 0;
  // True if levels are left for the vertex stage: other warps test them while vertices are searched. Pairs that are not
  // rejected are the confirmed ones; only list_measured() makes a list of them.
  bool are_levels_left = false;
  // In small frames with a vertex stage: the result of each pair. Other frames write f.proximity.
  MeasuredPair* measured = nullptr;
  PlacedPair* placed = nullptr;  // in small frames: where their bodies are; null in others

  __device__ PlacedPair bodies(const FrameView& f, std::uint64_t k) const {
    if (placed != nullptr) return fetched(placed + k);
    const core::Pair pair = items[k];
    return {placed_shape(f, pair.i), placed_shape(f, pair.j)};
  }

  // Stores the result of pair k. Called by one thread.
  __device__ void tell(const FrameView& f, std::uint64_t k, const core::Proximity& nearest) const {
    if (measured == nullptr)
      f.proximity[k] = nearest;
    else if (are_levels_left)
      measured[k].nearest = nearest;
    else
      measured[k] = {nearest};
  }
};

// One of these pairs. The constructor loads all of its words, so that a thread waits once.
class NarrowPair {
 public:
  __device__ NarrowPair(const FrameView& f, const NarrowPairs& pairs, std::uint64_t k) : exists_(k < pairs.count) {
    if (!exists_) return;
    pair_ = pairs.items[k];
    if (pairs.measured != nullptr)
      measured_ = fetched(pairs.measured + k);
    else if (f.has_vertex_stage)
      measured_.nearest = f.proximity[k];
  }

  __device__ core::Pair pair() const { return pair_; }
  __device__ const core::Proximity& nearest() const { return measured_.nearest; }
  __device__ bool is_confirmed() const { return exists_ && measured_.is_rejected == 0; }
  __device__ bool touches(const FrameView& f) const {
    return is_confirmed() && (!f.has_vertex_stage || nearest().is_touching());
  }

 private:
  bool exists_;
  core::Pair pair_;
  MeasuredPair measured_;
};

// In small frames: copies results to f.proximity, in the order of f.confirmed; if levels were left, it first lists the
// confirmed pairs. Only the host reads these lists, so a block does this that has nothing else to do. `listed`: a word
// of the block's shared memory.
__device__ inline void list_measured(const FrameView& f, const NarrowPairs& pairs, std::uint32_t* listed) {
  if (threadIdx.x == 0) *listed = 0;
  __syncthreads();
  for (std::uint64_t base = 0; base < pairs.count; base += blockDim.x) {
    const std::uint64_t k = base + threadIdx.x;
    const NarrowPair narrow(f, pairs, k);
    std::uint64_t place = k;
    if (pairs.are_levels_left) place = warp_append_one(narrow.is_confirmed(), listed);
    if (!narrow.is_confirmed()) continue;
    if (pairs.are_levels_left) f.confirmed.items[place] = narrow.pair();
    f.proximity[place] = narrow.nearest();
  }
}

}  // namespace broadside::gpu

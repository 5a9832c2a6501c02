// The pairs that the vertex stage measures, or is left out for, and that the response collects.
#pragma once

#include "core/method/proximity.hpp"
#include "core/pair.hpp"
#include "gpu/frame/frame_view.hpp"
#include "gpu/frame/measured_pair.hpp"
#include "gpu/stages/grid/fetched.cuh"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// The confirmed pairs; or all that level 0 found, where levels are left.
struct MeetingPairs {
  const core::Pair* items = nullptr;
  std::uint64_t count = 0;
  // Levels are left for the vertex stage: other warps go down them while these pairs are measured, and those that are
  // not rejected then are the confirmed, and not listed yet.
  bool are_levels_left = false;
  // Of few bodies, where they are measured: what came of each. The others have f.proximity.
  MeasuredPair* measured = nullptr;
  PlacedPair* placed = nullptr;  // likewise: where their bodies are; of many, none

  __device__ PlacedPair bodies(const FrameView& f, std::uint64_t k) const {
    if (placed != nullptr) return awaited(placed + k);
    const core::Pair pair = items[k];
    return {placed_shape(f, pair.i), placed_shape(f, pair.j)};
  }

  // By one thread.
  __device__ void tell(const FrameView& f, std::uint64_t k, const core::Proximity& nearest) const {
    if (measured == nullptr)
      f.proximity[k] = nearest;
    else if (are_levels_left)
      measured[k].nearest = nearest;
    else
      measured[k] = {nearest};
  }
};

// One of them. All of its words are asked for at once, and looked at when something is asked about it.
class Meeting {
 public:
  __device__ Meeting(const FrameView& f, const MeetingPairs& pairs, std::uint64_t k) : exists_(k < pairs.count) {
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

// Of few bodies: what was measured in a list of its own, beside the confirmed, which were not listed yet where levels
// were left. Nobody waits for it but who reads the frame, so it is for a block that has nothing else to do. `listed`:
// in its shared memory.
__device__ inline void list_measured(const FrameView& f, const MeetingPairs& pairs, std::uint32_t* listed) {
  if (threadIdx.x == 0) *listed = 0;
  __syncthreads();
  for (std::uint64_t base = 0; base < pairs.count; base += blockDim.x) {
    const std::uint64_t k = base + threadIdx.x;
    const Meeting meeting(f, pairs, k);
    if (k < pairs.count) take_away(pairs.placed + k);
    std::uint64_t place = k;
    if (pairs.are_levels_left) place = warp_append_one(meeting.is_confirmed(), listed);
    if (!meeting.is_confirmed()) continue;
    if (pairs.are_levels_left) f.confirmed.items[place] = meeting.pair();
    f.proximity[place] = meeting.nearest();
  }
}

}  // namespace broadside::gpu

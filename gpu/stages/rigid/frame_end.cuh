// What a frame of turning bodies tells the host, and whether it is aborted.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/rigid/frame_marks.cuh"

namespace broadside::gpu {

// The frame stops: a count is above its room. Counts of kernels to come are zero.
__device__ inline bool lacks_room(const RigidFrameView& f) {
  return lacks_pairs(f) || f.counts->confirmed > f.confirmed.capacity || f.counts->patches > f.patches.capacity ||
         f.counts->colors > f.color_capacity || f.counts->places > f.place_capacity;
}

// By one thread, when no other reads the counts any more. Of an aborted frame they say what it needed. Leaves zeros for
// the next frame.
__device__ inline void tell_host(const RigidFrameView& f, bool is_aborted) {
  RigidCounts counts = *f.counts;
  counts.is_aborted = is_aborted ? 1 : 0;
  f.outcome->counts = counts;
  *f.counts = RigidCounts{};
  for (std::uint32_t color = 0; color < counts.colors && color < f.color_capacity; ++color) f.color_count[color] = 0;
}

}  // namespace broadside::gpu

// What a frame of turning bodies tells the host, and whether it is aborted.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"
#include "gpu/stages/rigid/frame_marks.cuh"

namespace broadside::gpu {

// Whether the frame is aborted: a count is above its room, or a sleeping island wakes. Counts of kernels that have not
// run yet are zero.
__device__ inline bool lacks_room(const RigidFrameView& f) {
  return lacks_pairs(f) || f.counts->woken != 0 || f.counts->confirmed > f.confirmed.capacity ||
         f.counts->patches > f.patches.capacity || f.counts->colors > f.color_capacity ||
         f.counts->places > f.place_capacity;
}

// By one thread, when no other reads the counts any more. Of an aborted frame the counts say what it needed. Leaves
// zeros for the next frame.
__device__ inline void tell_host(const RigidFrameView& f, bool is_aborted) {
  RigidCounts counts = *f.counts;
  counts.is_aborted = is_aborted ? 1 : 0;
  f.outcome->counts = counts;
  *f.counts = RigidCounts{};
  f.counts->told_is_aborted = counts.is_aborted;
  f.counts->told_patches = counts.patches;
  for (std::uint32_t color = 0; color < counts.colors && color < f.color_capacity; ++color) f.color_count[color] = 0;
}

}  // namespace broadside::gpu

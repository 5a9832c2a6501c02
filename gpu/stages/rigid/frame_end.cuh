// What the kernels of a frame of turning bodies tell the host, and whether the frame is aborted.
#pragma once

#include "gpu/rigid/rigid_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

__device__ inline void mark(const RigidFrameView& f, bool is_first, core::Stage ended) {
  if (is_first) f.outcome->stage_end_ns[static_cast<std::size_t>(ended)] = now_ns();
}

// The broad phase aborted, or its cells were made for smaller boxes.
__device__ inline bool lacks_pairs(const RigidFrameView& f) {
  return f.counts->largest_side > f.side_limit || f.counts->largest_coordinate > f.coordinate_limit ||
         (f.has_broad && f.broad_counters->is_aborted != 0);
}

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

// When stages of a frame of turning bodies end, and whether the frame has its candidate pairs.
#pragma once

#include "gpu/rigid/contact_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

__device__ inline void mark(const ContactView& f, bool is_first, core::Stage ended) {
  if (is_first) f.outcome->stage_end_ns[static_cast<std::size_t>(ended)] = now_ns();
}

// Whether the host's plan is wrong for the pace of the step (PlannedPace).
__device__ inline bool is_misplanned(const ContactView& f) {
  const std::uint32_t pace = f.counts->fastest_m_s <= f.planned.calm_m_s ? 0 : max(f.counts->stride, 1U);
  return pace < f.planned.least || pace > f.planned.most;
}

// Whether the frame lacks its candidate pairs: the host's plan is wrong, the broad phase aborted, or its cells were
// made for smaller boxes.
__device__ inline bool lacks_pairs(const ContactView& f) {
  return is_misplanned(f) || f.counts->largest_side > f.side_limit ||
         f.counts->largest_coordinate > f.coordinate_limit || (f.has_broad && f.broad_counters->is_aborted != 0);
}

}  // namespace broadside::gpu

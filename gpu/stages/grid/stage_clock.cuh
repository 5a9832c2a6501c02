// Writes the device's clock, at the begin of a frame and at the end of each stage, for the host to read.
#pragma once

#include "gpu/frame/frame_view.hpp"
#include "gpu/stages/grid/device.cuh"

namespace broadside::gpu {

template <typename Team>
__device__ void mark_begin(const Team& team, Outcome* outcome) {
  if (team.rank() == 0) outcome->begin_ns = now_ns();
}

// `ended`: a core::Stage, or a FindStep where pairs are found without a frame.
template <typename Team, typename Stage>
__device__ void mark_end(const Team& team, Outcome* outcome, Stage ended) {
  if (team.rank() == 0) outcome->stage_end_ns[static_cast<std::uint32_t>(ended)] = now_ns();
}

}  // namespace broadside::gpu

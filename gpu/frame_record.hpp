// Copies what the last frame left on the device into a frame's record, in the record's order.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "core/trace/frame.hpp"
#include "gpu/frame_buffers.hpp"

namespace broadside::gpu {

// How much of each buffer the frame filled.
struct FrameCounts {
  std::uint64_t bodies = 0;
  std::uint64_t pairs = 0;
  std::uint64_t confirmed = 0;
  std::uint64_t proximity = 0;
  std::uint64_t contacts = 0;
  std::uint64_t face_contacts = 0;
};

// The device appends in any order; here pairs and confirmed pairs are sorted, contacts put in their order of
// application: by color, by pair, then by body and face. Fills all but step, time, digest and what a scene fixes.
core::Status read_frame(const FrameBuffers& buffers, const FrameCounts& counts, bool is_confirmed_by_level0,
                        core::FrameRecord& frame);

}  // namespace broadside::gpu

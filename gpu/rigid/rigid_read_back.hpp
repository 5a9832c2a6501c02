// What a frame of turning bodies left on the device, brought to the host.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "core/scene/rigid_bodies.hpp"
#include "core/trace/frame.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/rigid/rigid_buffers.hpp"

namespace broadside::gpu {

// Call after the step was kept: buffers.before() has the states that it ended in, buffers.after() those it began with.
struct RigidLeft {
  const core::RigidBodies& bodies;
  const RigidBuffers& buffers;
  const DeviceBuffer<core::Pair>& pairs;
  std::uint64_t pair_count = 0;
  RigidCounts counts;
};

// The digest, as the twin has it, added up on the device. Synchronizes.
core::Result<std::uint64_t> rigid_digest_of(const RigidLeft& left, const LaunchShape& shape, StreamHandle stream);
// Sorted as the twin's.
core::Status read_back_rigid(const RigidLeft& left, core::FrameRecord& frame);

}  // namespace broadside::gpu

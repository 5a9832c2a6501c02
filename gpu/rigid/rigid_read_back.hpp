// Copies what a frame of turning bodies left on the device to the host.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "core/scene/rigid_bodies.hpp"
#include "core/trace/frame.hpp"
#include "gpu/frame/frame_kernel.hpp"
#include "gpu/rigid/rigid_buffers.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::gpu {

// What a step that was kept, or a part of one, left on the device.
struct RigidLeft {
  const core::RigidBodies& bodies;
  const DeviceBuffer<core::RigidState>& state;     // in which it ended
  const DeviceBuffer<core::RigidState>& detected;  // in which it began
  const DeviceBuffer<PackedBox>& boxes;
  const DeviceBuffer<core::Pair>& pairs;
  const DeviceBuffer<core::Pair>& confirmed;
  const DeviceBuffer<core::ContactPatch>& patches;
  const DeviceBuffer<core::Vec3>& impulses;
  std::uint64_t pair_count = 0;
  RigidCounts counts;
};

// pairs: the first pair_count are those of the step.
inline RigidLeft left_of(const core::RigidBodies& bodies, const RigidBuffers& buffers,
                         const DeviceBuffer<core::Pair>& pairs, std::uint64_t pair_count, const RigidCounts& counts) {
  return {bodies,
          buffers.before(),
          buffers.after(),
          buffers.boxes(),
          pairs,
          buffers.confirmed(),
          buffers.patches(),
          buffers.impulses(),
          pair_count,
          counts};
}

// The digest, equal to the twin's, added up on the device. Synchronizes.
core::Result<std::uint64_t> rigid_digest_of(const RigidLeft& left, const LaunchShape& shape, StreamHandle stream);
// Fills the frame, in the twin's order.
core::Status read_back_rigid(const RigidLeft& left, core::FrameRecord& frame);

}  // namespace broadside::gpu

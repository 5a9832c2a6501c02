// All parts of a step except the last: they stay on the device until the frame is asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/trace/frame.hpp"
#include "gpu/rigid/rigid_read_back.hpp"

namespace broadside::gpu {

class EarlierParts {
 public:
  // Starts the next step: forgets the parts of the one before.
  void begin() { count_ = 0; }
  // Copies on the device, in the order of the stream.
  core::Status keep(const RigidLeft& part, StreamHandle stream);
  // last: the last part, as read back in full. It becomes the frame of the step (core::StepInParts).
  core::Status join(const core::RigidBodies& bodies, core::FrameRecord& last, core::RecordLevel level) const;
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  struct Part {
    DeviceBuffer<core::RigidState> state;
    DeviceBuffer<core::RigidState> detected;
    DeviceBuffer<PackedBox> boxes;
    DeviceBuffer<core::Pair> pairs;
    DeviceBuffer<core::Pair> confirmed;
    DeviceBuffer<core::ContactPatch> patches;
    DeviceBuffer<core::Vec3> impulses;
    std::uint64_t pair_count = 0;
    RigidCounts counts;
  };
  std::vector<std::unique_ptr<Part>> parts_;  // those from count_ on are room for later steps
  std::size_t count_ = 0;
};

}  // namespace broadside::gpu

// A frame of turning bodies as columns of the trace that lie on the device. Made when somebody asks.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/engine/frame_on_device.hpp"
#include "gpu/rigid/rigid_read_back.hpp"
#include "gpu/rigid/told_view.hpp"

namespace broadside::gpu {

class ToldFrame {
 public:
  // Valid until the next call, and as long as the buffers of what was left. Synchronizes.
  core::Result<core::DeviceFrame> tell(const RigidLeft& left, StreamHandle stream);

 private:
  struct Bodies {
    DeviceBuffer<core::Vec3> position, velocity, angular_velocity;
    DeviceBuffer<core::Quat> orientation;
  };
  struct Points {
    DeviceBuffer<std::uint32_t> a, b, feature, count;
    DeviceBuffer<core::Vec3> point, normal, impulse;
    DeviceBuffer<float> gap;
  };
  core::Status reserve(std::size_t bodies, std::size_t points);

  Bodies bodies_;
  Points points_;
  DeviceBuffer<core::RigidMass> mass_;
  DeviceBuffer<core::Vec3> static_spin_;
};

}  // namespace broadside::gpu

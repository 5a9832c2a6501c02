// A frame of turning bodies as columns of the trace in device memory. It is made when it is asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/contact_point.hpp"
#include "core/engine/frame_on_device.hpp"
#include "core/trace/frame.hpp"
#include "gpu/rigid/rigid_read_back.hpp"
#include "gpu/rigid/told_view.hpp"
#include "gpu/runtime/host_side.hpp"

namespace broadside::gpu {

class ToldFrame {
 public:
  // Call when another scene was loaded.
  void forget() { is_ready_ = is_told_ = false; }
  // The columns are valid until the next step or load, and as long as the buffers of the simulation. The first call
  // after a step launches and waits; later calls in the same step return the same columns.
  core::Result<core::DeviceFrame> tell(const RigidLeft& left, std::uint64_t step, StreamHandle stream);
  // The same of a frame that was put together on the host.
  core::Result<core::DeviceFrame> upload(const core::FrameRecord& frame, std::uint64_t step);

 private:
  struct Bodies {
    DeviceBuffer<core::Vec3> position, velocity, angular_velocity;
    DeviceBuffer<core::Quat> orientation;
  };
  struct Points {
    DeviceBuffer<std::uint32_t> a, b, feature;
    DeviceBuffer<core::Vec3> point, normal, impulse;
    DeviceBuffer<float> gap;
  };
  core::Status prepare(const RigidLeft& left);
  core::Status reserve_points(std::size_t points);
  core::Status upload_points(const std::vector<core::ContactPoint>& points);
  void fill_columns(ToldView& view) const;
  [[nodiscard]] ToldView view_of(const RigidLeft& left) const;
  core::Result<core::DeviceFrame> remember(core::DeviceFrame frame, std::uint64_t step);

  Bodies bodies_;
  Points points_;
  DeviceBuffer<core::Pair> pairs_;      // of a frame that was put together on the host
  DeviceBuffer<core::Pair> confirmed_;  // likewise
  DeviceBuffer<std::uint32_t> words_;   // points so far, blocks that are done
  Mapped<std::uint32_t, 1> told_points_;
  DeviceBuffer<core::RigidMass> mass_;
  DeviceBuffer<core::Vec3> static_spin_;
  bool is_ready_ = false;  // of the loaded scene: masses are there, bodies have room
  bool is_told_ = false;
  std::uint64_t step_ = 0;  // the step of frame_
  core::DeviceFrame frame_;
};

}  // namespace broadside::gpu

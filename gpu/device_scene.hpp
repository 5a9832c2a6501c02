// What of a scene does not change during a run, on the device.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/quat.hpp"
#include "core/scene/scene.hpp"
#include "gpu/device_buffer.hpp"
#include "gpu/frame_view.hpp"

namespace broadside::gpu {

class DeviceScene {
 public:
  core::Status load(const core::Scene& scene);
  // Fills what of the view is fixed by the scene.
  void fill(FrameView& view) const;

  [[nodiscard]] const core::Quat* orientation() const { return orientation_.data(); }
  // Of the deepest vertex tree.
  [[nodiscard]] std::uint32_t tree_levels() const { return tree_levels_; }
  // Longest side of any body's box, before it is placed.
  [[nodiscard]] float largest_side_m() const { return largest_side_m_; }
  [[nodiscard]] std::uint64_t shape_bytes() const;
  [[nodiscard]] std::uint64_t body_bytes() const;

 private:
  DeviceBuffer<PackedBox> octree_;
  DeviceBuffer<PackedBox> level2_;
  DeviceBuffer<std::uint32_t> level2_count_;
  DeviceBuffer<TreeHeader> trees_;
  DeviceBuffer<PackedBox> tree_nodes_;
  DeviceBuffer<PackedVec3> tree_vertices_;
  DeviceBuffer<std::uint32_t> shape_of_body_;
  DeviceBuffer<core::Material> material_;
  DeviceBuffer<core::Quat> orientation_;
  std::uint32_t tree_levels_ = 1;
  float largest_side_m_ = 0.0F;
};

}  // namespace broadside::gpu

// Stops bodies on the way of a step where they would pass through each other: the twin of
// reference/octree_cpu/rigid/sweep_stage.hpp.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/result.hpp"
#include "core/scene/rigid_bodies.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "gpu/rigid/swept_launch.hpp"
#include "gpu/rigid/swept_view.hpp"
#include "gpu/runtime/device_buffer.hpp"

namespace broadside::gpu {

// Its pairs are those whose boxes of whole ways overlap, which needs a search of its own. A step in which no body moves
// far skips it.
class SweepStage {
 public:
  core::Status load(const core::RigidBodies& bodies);
  // Call after the substeps of a frame that is kept. after: set back along the way where a body must stop.
  // Synchronizes.
  core::Status stop_short(const ContactView& frame, core::RigidState* after, StreamHandle stream);

  // How many bodies were set back since load; a body counts once for each step.
  [[nodiscard]] std::uint64_t stopped() const { return stopped_; }
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  core::Result<SweptCounts> counts() const;
  core::Status find_pairs(SweptView& view);

  LaunchShape shape_;
  float thinnest_m_ = 0.0F;  // half of the least thickness of all bodies
  std::vector<std::uint8_t> is_static_;
  std::unique_ptr<PairFinder> finder_;
  bool has_boxes_ = false;
  DeviceBuffer<float> length_m_;
  DeviceBuffer<core::Box> boxes_;
  DeviceBuffer<std::uint32_t> parts_;
  DeviceBuffer<std::uint32_t> next_parts_;
  DeviceBuffer<std::uint32_t> is_changed_;
  DeviceBuffer<SweptCounts> counts_;
  std::uint64_t stopped_ = 0;
};

}  // namespace broadside::gpu

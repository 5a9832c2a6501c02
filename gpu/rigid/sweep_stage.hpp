// Stops a body partway through its step where it would pass through another body: the twin of
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

// A body's way is its path in the step. Candidates are the pairs whose boxes around their whole ways overlap, which
// takes a broad phase of its own. A step in which no body moves far skips it.
class SweepStage {
 public:
  core::Status load(const core::RigidBodies& bodies);
  // Call after the substeps of a frame that is kept. after: the states that the substeps left; a body that must stop is
  // set back along its way. Synchronizes.
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

// The broad phase of octree-gpu on its own: boxes in, the exact set of overlapping pairs out.
#pragma once

#include <memory>

#include "core/engine/broad_phase.hpp"

namespace broadside::gpu {

// update() copies the boxes to the device and is charged for it; find() leaves the pairs on the device, in no order;
// read_back() copies and sorts them. Boxes that are not finite, or have min > max, are refused.
class PairFinder final : public core::BroadPhase {
 public:
  // has_tree: from 2048 boxes on, the hashed octree; otherwise all pairs in 32 x 32 tiles.
  explicit PairFinder(bool has_tree);
  ~PairFinder() override;

  [[nodiscard]] core::BroadPhaseTraits traits() const override { return {}; }
  core::Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override;
  core::Status update(std::span<const core::Box> boxes) override;
  core::Status find() override;
  core::Result<core::PairSet> read_back() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::gpu

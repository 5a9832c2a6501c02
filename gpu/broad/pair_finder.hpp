// The broad phases of the GPU engines on their own: boxes in, the exact set of overlapping pairs out.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/engine/broad_phase.hpp"
#include "core/engine/device_boxes.hpp"
#include "core/engine/pair_chunks.hpp"
#include "core/engine/search_path.hpp"
#include "core/engine/work_counting.hpp"
#include "core/method/box_passes.hpp"
#include "gpu/broad/find_time.hpp"
#include "gpu/broad/pair_finder_options.hpp"

namespace broadside::gpu {

// update() copies the boxes to the device and is charged for it; find() leaves the pairs on the device, in no order;
// read_back() copies and sorts them. Boxes that are not finite, or have min > max, are refused.
class PairFinder final : public core::BroadPhase,
                         public core::TakesDeviceBoxes,
                         public core::HandsPairsOn,
                         public core::CountsWork,
                         public core::TellsPath {
 public:
  explicit PairFinder(const PairFinderOptions& options);
  ~PairFinder() override;

  [[nodiscard]] core::BroadPhaseTraits traits() const override;
  core::Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override;
  core::Status update(std::span<const core::Box> boxes) override;
  // The spatial hash takes boxes from the host alone: it counts their cells before it makes room. Boxes from the device
  // are searched as they are: passes are planned from boxes that the host has seen.
  core::Status load_on_device(const core::DeviceBoxes& boxes, std::span<const std::uint8_t> is_static) override;
  core::Status update_on_device(const core::DeviceBoxes& boxes) override;
  [[nodiscard]] core::Result<core::DevicePairs> pairs_on_device() const override;
  core::Status find() override;
  // With pairs_at_once: find() counts, and read_back() searches again and gathers all in the host's memory.
  core::Result<core::PairSet> read_back() override;
  core::Status hand_on(const Consumer& take) override;
  // Launches, bytes that load and update copied to the device, and bytes of device memory; where it was asked to count
  // work, box tests and nodes visited. The same on every GPU.
  [[nodiscard]] std::vector<core::Counter> counters() const override;
  void count_work() override;
  [[nodiscard]] std::string path() const override;

  // Of the last find().
  [[nodiscard]] FindTime find_time() const;
  // Of the boxes that were given last.
  [[nodiscard]] const core::PassPlan& plan() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::gpu

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

// update() copies the boxes to the device, and its time includes that; find() leaves the pairs on the device, in no
// order; read_back() copies and sorts them. Boxes that are not finite, or have min > max, are refused.
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
  // The spatial hash takes boxes from the host only, because it counts their cells before it makes room. If a sample of
  // the boxes on the device shows that they need passes, the host copies them and makes the passes.
  core::Status load_on_device(const core::DeviceBoxes& boxes, std::span<const std::uint8_t> is_static) override;
  core::Status update_on_device(const core::DeviceBoxes& boxes) override;
  [[nodiscard]] core::Result<core::DevicePairs> pairs_on_device() const override;
  core::Status find() override;
  // With pairs_at_once, find() only counts pairs, and read_back() searches again and gathers all of them in the host's
  // memory.
  core::Result<core::PairSet> read_back() override;
  core::Status hand_on(const Consumer& take) override;
  // Counts launches, bytes that load and update copied to the device, and bytes of device memory; if it was asked to
  // count work, also box tests and nodes visited. The counts are the same on every GPU.
  [[nodiscard]] std::vector<core::Counter> counters() const override;
  void count_work() override;
  [[nodiscard]] std::string path() const override;

  // The time of the last find().
  [[nodiscard]] FindTime find_time() const;
  // The plan for the boxes that were given last.
  [[nodiscard]] const core::PassPlan& plan() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::gpu

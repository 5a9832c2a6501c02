// `broad=kept` on the GPU, for boxes that move little from frame to frame: the pairs of one search are kept as
// candidates for as long as they are sure to hold every pair.
//
// A search tests boxes that are fattened on each side. Its pairs are candidates for as long as every box lies within
// its fat box, because two boxes that overlap then lie in fat boxes that overlap. While that holds, a frame tests the
// candidates and searches nothing; once a box has left its fat box, there is a new search. So every frame is exact,
// even if all boxes jump. A search of fat boxes whose candidates served no further frame costs more than one of the
// boxes as they are. After each such search in a row, the boxes are searched as they are for twice as many frames as
// before, and then fat boxes are tried again.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/engine/broad_phase.hpp"
#include "core/engine/device_boxes.hpp"
#include "core/engine/search_path.hpp"
#include "gpu/broad/pair_finder_options.hpp"

namespace broadside::gpu {

// Calls, errors and zones are those of PairFinder.
class KeptFinder final : public core::BroadPhase, public core::TakesDeviceBoxes, public core::TellsPath {
 public:
  explicit KeptFinder(const PairFinderOptions& options);
  ~KeptFinder() override;

  [[nodiscard]] core::BroadPhaseTraits traits() const override { return {}; }
  core::Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override;
  core::Status update(std::span<const core::Box> boxes) override;
  core::Status load_on_device(const core::DeviceBoxes& boxes, std::span<const std::uint8_t> is_static) override;
  core::Status update_on_device(const core::DeviceBoxes& boxes) override;
  core::Status find() override;
  core::Result<core::PairSet> read_back() override;
  [[nodiscard]] core::Result<core::DevicePairs> pairs_on_device() const override;
  // How many frames searched, how many only tested candidates, and how many candidates were tested.
  [[nodiscard]] std::vector<core::Counter> counters() const override;
  [[nodiscard]] std::string path() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::gpu

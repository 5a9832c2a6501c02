// `broad=kept` on the GPU: for boxes that move little from frame to frame, what was found is kept while it must still
// hold every pair.
//
// A search is made of boxes that are fattened on each side. Its pairs are candidates for as long as every box lies
// within its fat one: boxes that overlap lie in fat boxes that do. A frame in which all do tests the candidates and
// searches nothing; the first box that leaves makes a new search. So every frame is exact, also when everything jumps.
// Searches whose candidates served no further frame cost more than one of the boxes as they are; after each such search
// in a row twice as many frames are searched as they are before it is tried again.
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
  // Frames that were searched, frames that tested candidates alone, and the candidates tested.
  [[nodiscard]] std::vector<core::Counter> counters() const override;
  [[nodiscard]] std::string path() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace broadside::gpu

// Searches static and moving boxes apart. Static boxes are put in order once: the host compares them in every update,
// and their table is kept until one of them changes. Moving boxes look for partners among themselves and in that table.
// Two static boxes are never tested.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/broad/box_search.hpp"
#include "gpu/broad/cross_view.hpp"

namespace broadside::gpu {

// Whether it pays: there are enough boxes, and at least an eighth of them, but not all, are static.
bool is_worth_keeping_apart(std::span<const std::uint8_t> is_static, const PairFinderOptions& options);

class ApartSearch {
 public:
  // Call it before the first boxes with these flags.
  void start(std::span<const std::uint8_t> is_static, const PairFinderOptions& options);
  // The boxes must be sound. Returns false if a moving box would cover too many cells of the smallest static boxes, or
  // if a box is longer than any cell: search the whole set together then.
  core::Result<bool> load(std::span<const core::Box> boxes, const Stream& stream);

  core::Status launch(StreamHandle stream);
  // Valid once the stream was waited for. Whether pairs were lost for want of room; grow() then makes room for them.
  [[nodiscard]] bool is_aborted() const { return has_moving() && moving_.is_aborted(); }
  core::Status grow() { return moving_.grow(); }
  [[nodiscard]] FoundPairs found() const { return has_moving() ? moving_.found() : FoundPairs{}; }

  [[nodiscard]] const Outcome& outcome() const { return moving_.outcome(); }
  [[nodiscard]] std::uint64_t launches() const { return moving_.launches() + 1; }
  [[nodiscard]] std::uint64_t bytes() const {
    return standing_.bytes() + moving_.bytes() + cell_words_.bytes() + near_.bytes();
  }
  // These three count since start().
  [[nodiscard]] std::uint64_t static_builds() const { return static_builds_; }
  [[nodiscard]] std::uint64_t static_boxes_kept() const { return static_boxes_kept_; }
  [[nodiscard]] std::uint64_t bytes_to_device() const { return bytes_to_device_; }

 private:
  [[nodiscard]] bool has_moving() const { return !moving_ids_.empty(); }
  core::Result<bool> load_standing(std::span<const core::Box> boxes, const Stream& stream);
  core::Status mark_cells(float largest_side_m, const Stream& stream);
  core::Result<bool> load_moving(std::span<const core::Box> boxes);

  PairFinderOptions options_;
  std::vector<std::uint32_t> standing_ids_;
  std::vector<std::uint32_t> moving_ids_;
  std::vector<core::Box> standing_boxes_;  // as they were when the table was made
  std::vector<PackedBox> packed_;
  BoxSearch standing_;
  BoxSearch moving_;
  DeviceBuffer<std::uint32_t> cell_words_;
  DeviceBuffer<std::uint32_t> near_;  // [0]: how many; then the moving boxes that may have partners
  CrossView cross_;
  LaunchShape cross_shape_;
  bool has_table_ = false;
  float finest_cell_m_ = 0.0F;  // the finest cells that have static boxes
  std::uint64_t static_builds_ = 0;
  std::uint64_t static_boxes_kept_ = 0;
  std::uint64_t bytes_to_device_ = 0;
};

}  // namespace broadside::gpu

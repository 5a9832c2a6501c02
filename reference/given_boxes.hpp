// The boxes that a broad phase was given, and the filter that makes an engine's raw pairs comparable. Every reference
// is judged on the same exact set (METHOD section 2), so pairs of fat boxes and stale pairs are removed here, and the
// time is charged to the engine.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/engine/broad_phase.hpp"

namespace broadside::reference {

class GivenBoxes {
 public:
  // Copies both. Errors: lengths differ, a box that is not finite or has min > max (named by its index).
  core::Status load(std::string_view engine, std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static);
  // Copies. Error: not as many boxes as were loaded. Values are not checked: this is inside a timed zone.
  core::Status update(std::string_view engine, std::span<const core::Box> boxes);

  [[nodiscard]] std::span<const core::Box> boxes() const { return boxes_; }
  [[nodiscard]] std::span<const std::uint8_t> is_static() const { return is_static_; }
  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(boxes_.size()); }

  // Keeps the pairs whose given boxes overlap, P(6), and that are not both static; sorts them and drops repetitions.
  // raw = how many pairs the engine gave, filter_s = the time of keeping (not of sorting), demanded = how many are
  // left.
  [[nodiscard]] core::PairSet tighten(std::vector<core::Pair> raw) const;

 private:
  std::vector<core::Box> boxes_;
  std::vector<std::uint8_t> is_static_;
};

}  // namespace broadside::reference

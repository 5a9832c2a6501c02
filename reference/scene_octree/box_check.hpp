// Refuses boxes for which no broad phase is defined: not finite, or inside out.
#pragma once

#include <cstdint>
#include <span>

#include "core/math/box.hpp"
#include "core/result.hpp"

namespace broadside::reference {

// Comparisons alone, so that a loop over boxes vectorizes; false for NaN, infinity and min > max.
inline bool is_sound_box(const core::Box& b) {
  constexpr float kMost = std::numeric_limits<float>::max();
  return (b.min.x >= -kMost) & (b.min.x <= b.max.x) & (b.max.x <= kMost) & (b.min.y >= -kMost) & (b.min.y <= b.max.y) &
         (b.max.y <= kMost) & (b.min.z >= -kMost) & (b.min.z <= b.max.z) & (b.max.z <= kMost);
}

// The error for the first box that is not sound.
core::Error unsound_box(std::span<const core::Box> boxes);

// Names the first body whose box is not sound.
core::Status check_boxes(std::span<const core::Box> boxes);

// For update: as many boxes as were loaded.
core::Status check_box_count(std::size_t given, std::size_t loaded);

}  // namespace broadside::reference

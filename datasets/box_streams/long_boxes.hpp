// Are a few boxes of a set far longer than the rest? Said beside times, because such a set slows some engines by a
// factor, and the times alone would look like a fault of the engine.
#pragma once

#include <span>
#include <string>

#include "core/math/box.hpp"

namespace broadside::datasets {

// How many times longer than the median box's longest side a box's longest side must be.
inline constexpr double kFarLonger = 1e4;

// "1 of 100000 boxes is 1e+06 times longer than the median: ..."; empty where no box is, or where the median is a
// point.
std::string long_boxes_remark(std::span<const core::Box> boxes);

}  // namespace broadside::datasets

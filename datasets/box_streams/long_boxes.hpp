// Are a few boxes of a set far longer than the rest? A remark next to the times says so, because such a set slows some
// engines by a large factor, and the times alone would look like a fault of the engine.
#pragma once

#include <span>
#include <string>

#include "core/math/box.hpp"

namespace broadside::datasets {

// A box is far longer when its longest side is this many times that of the median box.
inline constexpr double kFarLonger = 1e4;

// "1 of 100000 boxes is 1e+06 times longer than the median: ..."; empty where no box is far longer, or where the median
// box is a point.
std::string long_boxes_remark(std::span<const core::Box> boxes);

}  // namespace broadside::datasets

// The boxes of the triangles of a folding cloth, frame by frame: the input of a broad phase for the self-collision of a
// deforming surface. Neighboring triangles share vertices, so their boxes touch; folded layers come close.
#pragma once

#include <cstdint>

#include "datasets/box_streams/box_stream.hpp"

namespace broadside::datasets {

// A square cloth of n triangles with legs of 1, wrinkled by two traveling waves and folded like an accordion in 8
// panels: flat in the first frame, and in the last frame neighboring panels are folded by 0.98 of a half turn. Not
// seeded.
BoxStream sheet_boxes(std::uint32_t n, std::uint32_t frames);

}  // namespace broadside::datasets

// The triangles' boxes of a cloth that folds, frame by frame: what a broad phase is given for the self-collision of a
// deforming surface. Neighbors share vertices, so their boxes touch; folded layers come close.
#pragma once

#include <cstdint>

#include "datasets/box_streams/box_stream.hpp"

namespace broadside::datasets {

// A square cloth of n triangles with legs of 1, wrinkled by two waves that travel, folded like an accordion in 8
// panels: flat in the first frame, and in the last the panels stand at 0.98 of a half turn to each other. Not seeded.
BoxStream sheet_boxes(std::uint32_t n, std::uint32_t frames);

}  // namespace broadside::datasets

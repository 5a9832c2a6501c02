// Boxes that fill their world very unevenly: along a curve, in a fractal, or over all scales of a float. A grid over
// such a world has most of its cells empty and most of its boxes in a few cells. Seeded, of any count, made by pure
// functions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/box.hpp"

namespace broadside::datasets {

// Along 64 turns of a flat spiral whose radius grows with the square of the box's number. Sides are 1.5 times the
// distance to the next box: each box overlaps its neighbors on the curve, and near the center other turns. Ids are
// shuffled.
std::vector<core::Box> spiral_boxes(std::uint32_t n, std::uint64_t seed);

// Centers drawn from Cantor's set on each axis: numbers whose digits in base 3 are 0 and 2. There are as many digits
// before the point as give each box a cube of side 1 on average; sides 0.5 to 1.5.
std::vector<core::Box> cantor_boxes(std::uint32_t n, std::uint64_t seed);

// Positions and sizes over all exponents: a scale of 2^-140 to 2^124, with the center within that scale on each axis
// and sides from a quarter to 2^-13 of it. Boxes that contain the origin overlap most of those of smaller scales: some
// 8 per box at 30,000 boxes.
std::vector<core::Box> exponent_boxes(std::uint32_t n, std::uint64_t seed);

}  // namespace broadside::datasets

// Boxes that fill their world very unevenly: along a curve, in a fractal, over every scale that a float has. A grid
// over such a world has most of its cells empty and most of its boxes in few. Seeded, any count, pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/box.hpp"

namespace broadside::datasets {

// Along 64 turns of a flat spiral whose radius grows with the square of the number, sides 1.5 times the way to the next
// box: each overlaps its neighbors on the curve, and near the center other turns. Ids are shuffled.
std::vector<core::Box> spiral_boxes(std::uint32_t n, std::uint64_t seed);

// Centers drawn from Cantor's set on each axis: numbers whose digits to the base of 3 are 0 and 2. As many digits
// before the point as make a cube of side 1 for each box, on average; sides 0.5 to 1.5.
std::vector<core::Box> cantor_boxes(std::uint32_t n, std::uint64_t seed);

// Places and sizes over all exponents: a scale of 2^-140 to 2^124, the center within it on each axis, sides a quarter
// to 2^-13 of it. Boxes that hold the origin overlap most of those of smaller scales: some 8 a box at 30,000 boxes.
std::vector<core::Box> exponent_boxes(std::uint32_t n, std::uint64_t seed);

}  // namespace broadside::datasets

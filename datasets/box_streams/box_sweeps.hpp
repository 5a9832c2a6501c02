// Sets of boxes in which one property varies and the number of overlaps per box stays constant, to find sudden changes
// in speed: density, size ratio, clustering. Seeded, of any count, made by pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/box.hpp"

namespace broadside::datasets {

// uniform_boxes in a cube of volume n / density: about 8 * density overlaps per box. density > 0.
std::vector<core::Box> boxes_of_density(std::uint32_t n, std::uint64_t seed, double density);

// Sides s times 0.8 to 1.2 per axis, with s drawn from a Pareto distribution with exponent 2 from 1 to `ratio`, in a
// cube so large that a box has about 8 overlaps whatever the ratio: two boxes overlap with probability E[(s + s')^3] /
// volume. ratio >= 1.
std::vector<core::Box> boxes_of_size_ratio(std::uint32_t n, std::uint64_t seed, double ratio);

// 16 cubes of uniform boxes on a 4 x 4 grid, with centers `gap` cube widths apart. Inside a cube the boxes are as in
// uniform_boxes, but the larger the gap, the smaller the part of the world that holds boxes. gap >= 1; 1 = the cubes
// touch.
std::vector<core::Box> boxes_of_gap(std::uint32_t n, std::uint64_t seed, double gap);

}  // namespace broadside::datasets

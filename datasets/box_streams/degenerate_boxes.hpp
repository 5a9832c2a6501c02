// Sets of boxes on which a broad phase easily goes wrong: for comparing answers, not times.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/box.hpp"

namespace broadside::datasets {

// All boxes are the cube from 0 to 1: every pair overlaps, n (n - 1) / 2 of them.
std::vector<core::Box> identical_boxes(std::uint32_t n);

// Unit cubes at whole numbers, filled x first, then y, then z, in a cube of the smallest whole width that holds n. All
// coordinates are exact, so neighbors touch in faces, edges and corners and nothing overlaps by more: up to 26 pairs
// per box, which are found only where intervals are closed.
std::vector<core::Box> touching_boxes(std::uint32_t n);

// uniform_boxes' sides, centers uniform along the x axis from 0 to n / 4: about 8 overlaps each. Two of the three axes
// do not separate any boxes.
std::vector<core::Box> line_boxes(std::uint32_t n, std::uint64_t seed);

// uniform_boxes' sides, centers uniform in a square of area n / 2 in the plane z = 0: about 8 overlaps each.
std::vector<core::Box> plane_boxes(std::uint32_t n, std::uint64_t seed);

// Boxes without volume: depending on its number, a box is a point, a segment along x of length 1, or a unit square in x
// and y, with whole coordinates from 0 to the cube root of n. Many coincide, and a side is exactly 0 or 1.
std::vector<core::Box> flat_boxes(std::uint32_t n, std::uint64_t seed);

// uniform_boxes moved by 1e6 on every axis, where a float's step is 1/16: sides are rounded, and many boxes touch
// exactly.
std::vector<core::Box> far_boxes(std::uint32_t n, std::uint64_t seed);

// uniform_boxes scaled by 1e-6.
std::vector<core::Box> tiny_boxes(std::uint32_t n, std::uint64_t seed);

// uniform_boxes scaled by 2^-140: every coordinate is below 2^-126 for n up to 1,000,000,000, so all are subnormal, on
// a lattice of 512 steps per unit. Flushing subnormal numbers to zero makes all boxes equal.
std::vector<core::Box> subnormal_boxes(std::uint32_t n, std::uint64_t seed);

}  // namespace broadside::datasets

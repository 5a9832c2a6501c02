// The sets of boxes that broad phases are raced on: seeded, any count, pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/box.hpp"
#include "datasets/box_streams/box_stream.hpp"

namespace broadside::datasets {

// Sides uniform in 0.5 to 1.5 per axis, centers uniform in a cube of volume n: about 8 overlaps a box (two boxes
// overlap when their centers are within the mean of their sides, 1 on average, per axis and direction: a volume of
// 2^3).
std::vector<core::Box> uniform_boxes(std::uint32_t n, std::uint64_t seed);

// 16 cones as high as their radius, of boxes on a lattice of spacing 1 jittered by 0.1, sides 0.84 to 1.24, with
// centers four radii apart, and at least 1 % strays over a ground 64 times wider; ids shuffled. Centers crowd in a
// corner of a wide world, which is hard on codes of few bits.
std::vector<core::Box> heap_boxes(std::uint32_t n, std::uint64_t seed);

// Sides s times 0.8 to 1.2 per axis, s Pareto with exponent 2 from 1 to 1000, one box of 1000, in a cube of volume 520
// n: a few giants overlap thousands.
std::vector<core::Box> mixed_boxes(std::uint32_t n, std::uint64_t seed);

// uniform_boxes, each moving by 1 % of its mean side a frame in a direction of its own and turning round at the walls
// of the cube; each frame, every box jumps to a new place with probability `teleport_share`.
BoxStream moving_boxes(std::uint32_t n, std::uint64_t seed, std::uint32_t frames, double teleport_share);

}  // namespace broadside::datasets

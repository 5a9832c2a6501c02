// Sets of boxes for comparing the speed of broad phases: seeded, of any count, made by pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/box.hpp"
#include "datasets/box_streams/box_stream.hpp"

namespace broadside::datasets {

// Sides uniform in 0.5 to 1.5 per axis, centers uniform in a cube of volume n: about 8 overlaps per box. (Two boxes
// overlap when their centers are, on each axis, nearer than the mean of their sides, which is 1 on average, in either
// direction: a volume of 2^3.)
std::vector<core::Box> uniform_boxes(std::uint32_t n, std::uint64_t seed);

// 16 cones as high as their radius, made of boxes on a lattice of spacing 1 jittered by 0.1, with sides 0.84 to 1.24.
// Their centers are four radii apart, and at least 1 % of the boxes are strays over a ground 64 times wider; ids are
// shuffled. Centers crowd in a corner of a wide world, which is difficult for space-filling curves with few bits.
std::vector<core::Box> heap_boxes(std::uint32_t n, std::uint64_t seed);

// Sides s times 0.8 to 1.2 per axis, with s drawn from a Pareto distribution with exponent 2 from 1 to 1000, and one
// box of 1000, in a cube of volume 520 n: a few huge boxes overlap thousands.
std::vector<core::Box> mixed_boxes(std::uint32_t n, std::uint64_t seed);

// uniform_boxes, each moving by 1 % of its mean side per frame in its own direction and reversing at the walls of the
// cube. In each frame, every box jumps to a new place with probability `teleport_share`.
BoxStream moving_boxes(std::uint32_t n, std::uint64_t seed, std::uint32_t frames, double teleport_share);

}  // namespace broadside::datasets

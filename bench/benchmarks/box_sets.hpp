// The boxes that broad phases are raced on: seeded, any count.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/box.hpp"

namespace broadside::bench {

// Sides uniform in 0.5 to 1.5 per axis, centers uniform in a cube of volume n: about 8 overlaps a box.
std::vector<core::Box> uniform_boxes(std::uint32_t n, std::uint64_t seed);

// 16 cones of boxes on a jittered lattice of spacing 1, sides 0.84 to 1.24, apart by four radii, and 1 % strays over a
// ground 64 times wider; ids shuffled. Centers crowd in a corner of a wide world.
std::vector<core::Box> heap_boxes(std::uint32_t n, std::uint64_t seed);

// Sides s times 0.8 to 1.2, s Pareto with exponent 2 from 1 to 1000, one box of 1000, in a cube of volume 520 n.
std::vector<core::Box> mixed_boxes(std::uint32_t n, std::uint64_t seed);

}  // namespace broadside::bench

// Boxes that are long on one axis and thin on the others, such as those of wires, hairs and the triangles of bad
// meshes. A cell as large as such a box is long holds many boxes that do not overlap. Seeded, of any count, made by
// pure functions.
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/box.hpp"

namespace broadside::datasets {

// 100 m long along an axis drawn at random, 0.1 mm thick on the two others, centers uniform in a cube of 100 m. Two
// boxes along different axes overlap with probability (3/4)^2 2e-6, so 100,000 have some 3,750 pairs, however many
// tests a search needs to find them.
std::vector<core::Box> needle_boxes(std::uint32_t n, std::uint64_t seed);

// Length 0.5 to 1.5 along an axis drawn at random, a thousandth of that on the two others, centers uniform in a cube of
// volume n / 6000: about 8 overlaps per box, nearly all between boxes along different axes.
std::vector<core::Box> sliver_boxes(std::uint32_t n, std::uint64_t seed);

}  // namespace broadside::datasets

// The fast scene octree, `broad=tree`: the formulas that determine its shape, for CPU and GPU alike.
//
// Boxes are sorted by size class, then by Hilbert code of their centers. Eight boxes in a row are a pack, eight packs a
// node, eight nodes their parent, and so on. It is an octree by count instead of by cell, so that clusters, wide worlds
// and coincident boxes cannot unbalance it. Each size class has its own tree, so that a huge box never enlarges the
// bounds of small ones. The order and the classes only decide how tight the bounds are, so no pair can be lost.
#pragma once

#include <bit>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/method/space_curve.hpp"

namespace broadside::core {

// Children of a node, and boxes of a pack: one vector register of float32 on AVX2, a quarter of a warp.
inline constexpr std::uint32_t kTreeWidth = 8;

// Largest number of classes; the class is in the top bits of the sort key.
inline constexpr int kMaxSizeClasses = 16;

// Bins by the exponent of the longest side: bin k holds sides in [2^(k-127), 2^(k-126)), bin 0 also zero and denormals,
// and bin 255 sides that overflow.
inline constexpr int kSizeBins = 256;

BROADSIDE_HD int size_bin(const Box& b) {
  const float x = b.max.x - b.min.x;
  const float y = b.max.y - b.min.y;
  const float z = b.max.z - b.min.z;
  const float xy = x < y ? y : x;
  const float side_m = xy < z ? z : xy;
  // The sign is masked: a box from +0 to -0 has a side of -0.
  return static_cast<int>((std::bit_cast<std::uint32_t>(side_m) & 0x7FFFFFFFU) >> 23U);
}

// A quarter of min + max: half the center, in a form that cannot overflow. Its rounding only affects the order.
BROADSIDE_HD Vec3 half_center(const Box& b) {
  return {0.25F * b.min.x + 0.25F * b.max.x, 0.25F * b.min.y + 0.25F * b.max.y, 0.25F * b.min.z + 0.25F * b.max.z};
}

// Cubic cells over the bounds of half centers, 2^bits along the longest side.
struct CurveGrid {
  Vec3 origin;
  // There are two factors because a single one would overflow for denormal bounds.
  float first_factor = 1.0F;
  float cells_per_m = 0.0F;
  float last_cell = 0.0F;
  int bits = 1;
};

// Twice as many bits as evenly spread boxes need; denser regions are sorted again in a grid of their own.
BROADSIDE_HD int curve_bits(std::uint32_t box_count, int most) {
  const int even = (static_cast<int>(std::bit_width(box_count)) + 2) / 3 + 2;
  return even < most ? even : most;
}

BROADSIDE_HD CurveGrid make_curve_grid(const Box& half_centers, int bits) {
  float extent_m = 0.0F;
  for (int axis = 0; axis < 3; ++axis) {
    const float side_m = half_centers.max[axis] - half_centers.min[axis];
    if (extent_m < side_m) extent_m = side_m;
  }
  CurveGrid grid;
  grid.origin = half_centers.min;
  grid.bits = bits;
  grid.first_factor = extent_m < 0x1p-60F ? 0x1p80F : 1.0F;
  const auto cells = static_cast<float>(1U << static_cast<unsigned>(bits));
  grid.cells_per_m = extent_m > 0.0F ? cells / (extent_m * grid.first_factor) : 0.0F;
  grid.last_cell = cells - 1.0F;
  return grid;
}

BROADSIDE_HD std::uint32_t curve_coordinate(const CurveGrid& grid, float offset_m) {
  // Half of an odd number of smallest subnormal steps is rounded, so a center may lie below the bounds of all centers.
  const float above_m = offset_m < 0.0F ? 0.0F : offset_m;
  const float cell = above_m * grid.first_factor * grid.cells_per_m;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(cell < grid.last_cell ? cell : grid.last_cell));
}

BROADSIDE_HD CurveCell curve_cell(const CurveGrid& grid, const Box& box) {
  const Vec3 c = half_center(box);
  return {curve_coordinate(grid, c.x - grid.origin.x), curve_coordinate(grid, c.y - grid.origin.y),
          curve_coordinate(grid, c.z - grid.origin.z)};
}

// Which pack finds a pair: the pack of the finer class; within a class, the pack that comes first.
BROADSIDE_HD constexpr bool finds(std::uint32_t pack_class, std::uint32_t pack, std::uint32_t other_class,
                                  std::uint32_t other) {
  return pack_class != other_class ? pack_class < other_class : pack <= other;
}

}  // namespace broadside::core

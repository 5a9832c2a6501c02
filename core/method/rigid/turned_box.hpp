// The tight axis-aligned box of a turned shape, RIGID 8.2: support points are found in closed form, by going along a
// hull's edges, or through the tree over a mesh's vertices. The box is rounded outward, so it contains the shape at
// exactly this pose.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/box.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/hull_climb.hpp"

namespace broadside::core {

// The vertices of a mesh by the leaves of their octree, in mesh coordinates. Level-1 box k holds the leaves
// 8 k to 8 k + 7; an empty leaf has no vertices.
struct VertexTreeView {
  const Box* level1 = nullptr;                // 8
  const Box* level2 = nullptr;                // 64
  const std::uint32_t* leaf_begin = nullptr;  // 65: leaf k has vertices leaf_begin[k] to leaf_begin[k + 1] - 1
  const Vec3* vertices = nullptr;
};

// An upper bound of how far any point of the box is along the direction. Products and sums round monotonically, so the
// bound holds for the rounded coordinates too.
BROADSIDE_HD constexpr float box_support(const Box& box, Vec3 d) {
  return (d.x * (d.x < 0.0F ? box.min.x : box.max.x) + d.y * (d.y < 0.0F ? box.min.y : box.max.y)) +
         d.z * (d.z < 0.0F ? box.min.z : box.max.z);
}

BROADSIDE_HD constexpr float leaf_support(const VertexTreeView& tree, std::uint32_t leaf, Vec3 d, float best) {
  for (std::uint32_t k = tree.leaf_begin[leaf]; k < tree.leaf_begin[leaf + 1]; ++k) {
    const float at = dot(d, tree.vertices[k]);
    if (at > best) best = at;
  }
  return best;
}

// The largest coordinate of the vertices along the direction. A maximum does not depend on the order, so the result is
// bit for bit that of a loop over all vertices.
BROADSIDE_HD float vertex_support(const VertexTreeView& tree, Vec3 d) {
  const auto is_empty = [&tree](std::uint32_t leaf) { return tree.leaf_begin[leaf] == tree.leaf_begin[leaf + 1]; };
  // The most promising leaf first: then few others are opened.
  float promise = -INFINITY;
  std::uint32_t first = 0;
  for (std::uint32_t leaf = 0; leaf < 64; ++leaf) {
    if (is_empty(leaf)) continue;
    const float bound = box_support(tree.level2[leaf], d);
    if (bound > promise) promise = bound, first = leaf;
  }
  float best = leaf_support(tree, first, d, -INFINITY);
  for (std::uint32_t k = 0; k < 8; ++k) {
    const std::uint32_t begin = 8 * k;
    const std::uint32_t end = begin + 8;
    if (tree.leaf_begin[begin] == tree.leaf_begin[end] || !(box_support(tree.level1[k], d) > best)) continue;
    for (std::uint32_t leaf = begin; leaf < end; ++leaf)
      if (!is_empty(leaf) && box_support(tree.level2[leaf], d) > best) best = leaf_support(tree, leaf, d, best);
  }
  return best;
}

// How far the shape reaches from its center along a direction of body axes, of length 1. A half-space has no end.
BROADSIDE_HD float shape_support(const ContactShape& s, const VertexTreeView& tree, Vec3 d) {
  switch (s.kind) {
    case ContactKind::kBox:
      return (fabsf(d.x) * s.half.x + fabsf(d.y) * s.half.y) + fabsf(d.z) * s.half.z;
    case ContactKind::kSphere:
      return s.radius_m;
    case ContactKind::kCapsule:
      return s.radius_m + s.half_length_m * fabsf(d[s.axis]);
    case ContactKind::kCylinder: {
      // Not sqrt(1 - d^2): where the axis lies along the direction, that root is off by the square root of a rounding.
      const float p = d[s.axis == 0 ? 1 : 0];
      const float q = d[s.axis == 2 ? 1 : 2];
      return s.half_length_m * fabsf(d[s.axis]) + s.radius_m * sqrtf(p * p + q * q);
    }
    case ContactKind::kHull:
      return dot(d, s.hull.vertices[lowest_along(s.hull, -d)]);
    case ContactKind::kMesh:
      return vertex_support(tree, d);
    case ContactKind::kHalfSpace:
      break;
  }
  return INFINITY;
}

// Roundings in units of 2^-24: four of the quaternion, eight from it to a direction, four to a coordinate along it, all
// of lengths up to the shape's reach; then two sums at the size of the position, and one of the recorded origin.
inline constexpr float kBoxRoundingsOfReach = 32.0F;
inline constexpr float kBoxRoundingsOfPosition = 4.0F;

// x: of the center of mass.
BROADSIDE_HD Box turned_box(const ContactShape& s, const VertexTreeView& tree, Vec3 x, Quat q) {
  constexpr float kUnit = 0x1p-24F;
  const TurnedAxes axes = turned_axes(q);
  const float reach = length(s.center) + s.size_m;
  Box box;
  for (int k = 0; k < 3; ++k) {
    const Vec3 d{axes.x[k], axes.y[k], axes.z[k]};
    const float center = dot(d, s.center);
    const float high = shape_support(s, tree, d);
    const bool is_even = s.kind != ContactKind::kHull && s.kind != ContactKind::kMesh;
    const float low = is_even ? high : shape_support(s, tree, -d);
    const float pad = kUnit * (kBoxRoundingsOfReach * reach + kBoxRoundingsOfPosition * fabsf(x[k]));
    box.min[k] = x[k] + ((center - low) - pad);
    box.max[k] = x[k] + ((center + high) + pad);
  }
  return box;
}

}  // namespace broadside::core

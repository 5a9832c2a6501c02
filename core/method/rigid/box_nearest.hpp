// The nearest points of two boxes that are apart, where no axis shows their distance: a corner of one box and the point
// of the other one that is nearest to it, found by clamping the corner's coordinates. (Where two edges are nearest to
// each other, the axis across both shows the distance.)
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/kept_loop.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/corner_layer.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/nearest_features.hpp"
#include "core/method/rigid/polytopes.hpp"

namespace broadside::core::box_detail {

// A corner of one box, and the point of the other one that is nearest to it.
struct NearestCorner {
  float squared_m2 = 3.402823e38F;
  int corner = 0;
  Vec3 nearest;  // in the axes of the other box, from its center
  Vec3 beyond;   // from there to the corner, in the same axes: 0 along an axis where the corner is within the box
};

BROADSIDE_HD_CALLED NearestCorner nearest_corner(const BoxPolytope& corners, const BoxPolytope& solid) {
  NearestCorner best;
  BROADSIDE_KEPT_LOOP
  for (int k = 0; k < 8; ++k) {
    const Vec3 x = turned_back(solid.axes, corners.corner(k) - solid.center);
    const Vec3 at{fmaxf(-solid.half.x, fminf(solid.half.x, x.x)), fmaxf(-solid.half.y, fminf(solid.half.y, x.y)),
                  fmaxf(-solid.half.z, fminf(solid.half.z, x.z))};
    const Vec3 d = x - at;
    const float squared = dot(d, d);
    if (squared < best.squared_m2) best = {squared, k, at, d};
  }
  return best;
}

// The name of the corner, edge or face of a box that its nearest point to a corner of the other box is on. outward:
// from that point to the corner, in the box's axes.
BROADSIDE_HD std::uint32_t name_on_box(Vec3 outward) {
  int lower = 0;
  int free_axis = -1;
  int free_count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (outward[axis] > 0.0F) lower |= 1 << axis;
    if (outward[axis] == 0.0F) {
      free_axis = axis;
      ++free_count;
    }
  }
  const auto corner = static_cast<std::uint32_t>(lower);
  if (free_count == 0) return corner_name(corner);
  if (free_count == 1) return edge_name(corner, corner | (1U << free_axis));
  const int across = outward.x != 0.0F ? 0 : (outward.y != 0.0F ? 1 : 2);
  return face_name(static_cast<std::uint32_t>(2 * across + (outward[across] > 0.0F ? 1 : 0)));
}

// The nearest points of two boxes that are apart, and bounds of their distance.
struct NearestOfBoxes {
  Vec3 normal;                  // unit, from B to A
  float gap_m = -3.402823e38F;  // along the normal: at most the distance
  float distance_m = 0.0F;      // of these points: at least the distance
  Vec3 on_a;
  Vec3 on_b;
  std::uint32_t name_a = 0;
  std::uint32_t name_b = 0;
};

BROADSIDE_HD void try_direction(const BoxPolytope& a, const BoxPolytope& b, Vec3 direction, NearestOfBoxes& best) {
  const float squared = dot(direction, direction);
  if (!(squared > 0.0F)) return;
  const Vec3 n = (1.0F / sqrtf(squared)) * direction;
  const float gap = gap_along(a, b, n);
  if (!(gap > best.gap_m)) return;
  best.gap_m = gap;
  best.normal = n;
}

BROADSIDE_HD_CALLED NearestOfBoxes nearest_of_boxes(const BoxPolytope& a, const BoxPolytope& b, float rounding_m) {
  NearestOfBoxes out;
  const NearestCorner of_a = nearest_corner(a, b);
  const NearestCorner of_b = nearest_corner(b, a);
  const bool is_of_a = !(of_b.squared_m2 < of_a.squared_m2);
  const NearestCorner& near = is_of_a ? of_a : of_b;
  const BoxPolytope& solid = is_of_a ? b : a;
  const Vec3 corner = is_of_a ? a.corner(near.corner) : b.corner(near.corner);
  const Vec3 on_solid = solid.center + turned(solid.axes, near.nearest);
  const std::uint32_t of_corner = corner_name(static_cast<std::uint32_t>(near.corner));
  const std::uint32_t of_solid = name_on_box(near.beyond);
  out.on_a = is_of_a ? corner : on_solid;
  out.on_b = is_of_a ? on_solid : corner;
  out.name_a = is_of_a ? of_corner : of_solid;
  out.name_b = is_of_a ? of_solid : of_corner;
  out.distance_m = sqrtf(near.squared_m2);
  const Vec3 outward = turned(solid.axes, near.beyond);
  Vec3 d = is_of_a ? outward : -outward;
  try_direction(a, b, d, out);
  // The corner may be nearest although a point of its edge is nearer by less than rounding: see nearest_direction.
  BROADSIDE_KEPT_LOOP
  for (int round = 0; round < 2 && out.gap_m > 0.0F && out.distance_m - out.gap_m > 2.0F * rounding_m; ++round) {
    const Vec3 u = a.corner(lowest_corner(a, out.normal)) - out.on_a;
    const Vec3 v = b.corner(lowest_corner(b, -out.normal)) - out.on_b;
    d = out.on_a - out.on_b;
    if (dot(out.normal, u) < 0.0F) d = without(d, u);
    if (dot(out.normal, v) > 0.0F) d = without(d, v);
    try_direction(a, b, d, out);
  }
  return out;
}

}  // namespace broadside::core::box_detail

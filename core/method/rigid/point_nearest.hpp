// The point of a solid's surface that is nearest to a given point, inside or outside; this is where a sphere touches.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/nearest_features.hpp"

namespace broadside::core {

// For a solid B and a point: the signed distance (negative inside), and the unit direction from the surface to the
// point; inside, the direction of the shortest way out.
struct PointDistance {
  float gap_m = 0.0F;
  Vec3 normal;
  std::uint32_t name = 0;  // of the part of the surface
};

// Any direction will do where the point is on the surface within rounding.
BROADSIDE_HD PointDistance point_to_point(Vec3 from, float rounding_m, std::uint32_t name) {
  const float distance = length(from);
  if (!(distance > rounding_m)) return {distance, {0.0F, 1.0F, 0.0F}, name};
  return {distance, (1.0F / distance) * from, name};
}

BROADSIDE_HD float within(float x, float limit) {
  return x < -limit ? -limit : (x > limit ? limit : x);
}

// Within rounding of the surface the direction between the two points is noise; the nearest face's normal takes its
// place.
BROADSIDE_HD PointDistance point_to_box(const PlacedShape& box, Vec3 p, float rounding_m) {
  const Vec3 half = box.shape->half;
  const Vec3 local = turned_back(box.axes, p - box.center);
  const Vec3 nearest{within(local.x, half.x), within(local.y, half.y), within(local.z, half.z)};
  const Vec3 from = local - nearest;
  const float distance = length(from);
  if (distance > rounding_m) {
    std::uint32_t name = 0;  // in base 3: below, within or above, axis by axis
    for (int k = 0; k < 3; ++k) name = 3 * name + (from[k] < 0.0F ? 0U : (from[k] > 0.0F ? 2U : 1U));
    return {distance, turned(box.axes, (1.0F / distance) * from), face_name(name)};
  }
  int axis = 0;
  float gap = fabsf(local.x) - half.x;
  for (int k = 1; k < 3; ++k) {
    const float other = fabsf(local[k]) - half[k];
    if (!(other > gap)) continue;
    gap = other;
    axis = k;
  }
  const bool is_upper = local[axis] > 0.0F;
  // The face's name among the 27: beyond it on its own axis only.
  std::uint32_t name = 0;
  for (int k = 0; k < 3; ++k) name = 3 * name + (k != axis ? 1U : (is_upper ? 2U : 0U));
  return {gap, is_upper ? box.axes[axis] : -box.axes[axis], face_name(name)};
}

// The distance to a capsule's segment, without its ball. From a point on the segment the way out is perpendicular to
// it.
BROADSIDE_HD PointDistance point_to_segment(const PlacedShape& capsule, Vec3 p, float rounding_m) {
  const int axis = capsule.shape->axis;
  const Vec3 local = turned_back(capsule.axes, p - capsule.center);
  Vec3 from = local;
  from[axis] = local[axis] - within(local[axis], capsule.shape->half_length_m);
  const float distance = length(from);
  const std::uint32_t name =
      from[axis] < 0.0F ? corner_name(0) : (from[axis] > 0.0F ? corner_name(1) : edge_name(0, 1));
  if (!(distance > rounding_m)) return {distance, capsule.axes[axis == 0 ? 1 : 0], name};
  return {distance, turned(capsule.axes, (1.0F / distance) * from), name};
}

// The distance to the exact round solid.
BROADSIDE_HD PointDistance point_to_cylinder(const PlacedShape& cylinder, Vec3 p, float rounding_m) {
  const int axis = cylinder.shape->axis;
  const float half_length = cylinder.shape->half_length_m;
  const float radius = cylinder.shape->radius_m;
  const Vec3 local = turned_back(cylinder.axes, p - cylinder.center);
  Vec3 across = local;
  across[axis] = 0.0F;
  const float from_axis = length(across);
  const bool is_upper = local[axis] > 0.0F;
  const float over_end = fabsf(local[axis]) - half_length;
  const float over_side = from_axis - radius;
  const Vec3 end = is_upper ? cylinder.axes[axis] : -cylinder.axes[axis];
  const std::uint32_t end_name = face_name(is_upper ? 1U : 0U);
  if (over_end > 0.0F && over_side > 0.0F) {
    const float distance = sqrtf(over_end * over_end + over_side * over_side);
    if (distance > rounding_m) {
      const Vec3 out = (over_side / from_axis) * turned(cylinder.axes, across) + over_end * end;
      return {distance, (1.0F / distance) * out, corner_name(is_upper ? 1U : 0U)};
    }
  }
  if (over_end >= over_side || !(from_axis > rounding_m)) {
    // On the axis of a cylinder that is longer than thick all directions across it are equally short: any will do.
    if (over_end >= over_side) return {over_end, end, end_name};
    return {over_side, cylinder.axes[axis == 0 ? 1 : 0], face_name(2)};
  }
  return {over_side, (1.0F / from_axis) * turned(cylinder.axes, across), face_name(2)};
}

namespace hull_detail {

// Whether the point lies between the sides of a face, seen along its normal. Body axes.
BROADSIDE_HD bool is_over(const HullView& hull, std::uint32_t f, Vec3 p) {
  const HullFace& face = hull.faces[f];
  for (std::uint32_t k = 0; k < face.corner_count; ++k) {
    const Vec3 start = hull.vertices[hull.corners[face.first_corner + k]];
    const Vec3 end = hull.vertices[hull.corners[face.first_corner + (k + 1 == face.corner_count ? 0 : k + 1)]];
    if (!(dot(cross(end - start, face.normal), p - start) <= 0.0F)) return false;
  }
  return true;
}

}  // namespace hull_detail

// Where the point is behind all planes, the highest plane is the shortest way out. Where it is in front of one, the
// nearest point is on a face that the point is over, or on an edge.
BROADSIDE_HD PointDistance point_to_hull(const PlacedShape& placed, Vec3 p, float rounding_m) {
  const HullView& hull = placed.shape->hull;
  const Vec3 local = turned_back(placed.axes, p - placed.center);
  std::uint32_t highest = 0;
  float height = -3.402823e38F;
  for (std::uint32_t f = 0; f < hull.face_count; ++f) {
    const float above = dot(hull.faces[f].normal, local) - hull.faces[f].offset_m;
    if (!(above > height)) continue;
    height = above;
    highest = f;
  }
  const PointDistance by_face{height, turned(placed.axes, hull.faces[highest].normal), face_name(highest)};
  // No point of the hull is nearer than the highest plane.
  if (!(height > rounding_m) || hull_detail::is_over(hull, highest, local)) return by_face;
  float least = 3.402823e38F;
  Vec3 from;
  std::uint32_t name = 0;
  for (std::uint32_t e = 0; e < hull.edge_count; ++e) {
    const Vec3 start = hull.vertices[hull.edges[e].from];
    const Vec3 end = hull.vertices[hull.edges[e].to];
    const float share = share_nearest(local, start, end);
    const Vec3 between = local - (share == 1.0F ? end : start + share * (end - start));
    const float squared = dot(between, between);
    if (!(squared < least)) continue;
    least = squared;
    from = between;
    name = share == 0.0F   ? corner_name(hull.edges[e].from)
           : share == 1.0F ? corner_name(hull.edges[e].to)
                           : edge_name(hull.edges[e].from, hull.edges[e].to);
  }
  for (std::uint32_t f = 0; f < hull.face_count; ++f) {
    const HullFace& other = hull.faces[f];
    const float above = dot(other.normal, local) - other.offset_m;
    if (!(above > 0.0F) || !(above * above < least)) continue;
    if (!hull_detail::is_over(hull, f, local)) continue;
    least = above * above;
    from = above * other.normal;
    name = face_name(f);
  }
  const float distance = sqrtf(least);
  if (!(distance > rounding_m)) return by_face;
  return {distance, turned(placed.axes, (1.0F / distance) * from), name};
}

// The distance to the whole body, with the ball around a sphere's center or a capsule's segment.
BROADSIDE_HD PointDistance point_to_solid(const PlacedShape& solid, Vec3 p, float rounding_m) {
  PointDistance out;
  switch (solid.shape->kind) {
    case ContactKind::kSphere:
      out = point_to_point(p - solid.center, rounding_m, 0);
      break;
    case ContactKind::kCapsule:
      out = point_to_segment(solid, p, rounding_m);
      break;
    case ContactKind::kBox:
      return point_to_box(solid, p, rounding_m);
    case ContactKind::kCylinder:
      return point_to_cylinder(solid, p, rounding_m);
    case ContactKind::kHull:
      return point_to_hull(solid, p, rounding_m);
    default:
      return {3.402823e38F, {0.0F, 1.0F, 0.0F}, 0};
  }
  out.gap_m = out.gap_m - solid.shape->radius_m;
  return out;
}

}  // namespace broadside::core

// Bounds of the distance of two closed-form shapes, boxes, capsules and cylinders, at given poses: hull_gap.hpp with
// farthest points by formulas.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/hull_gap.hpp"

namespace broadside::core {

// The deepest point of a cylinder along a direction. Before, where the direction was parallel to the axis to
// within rounding, the rim's point was sought along that rounding: up to a radius above the end, inside another
// cylinder that was 11 cm away.
BROADSIDE_HD_CALLED Vec3 farthest_of_cylinder(const PlacedShape& c, Vec3 towards) {
  const Vec3 along = c.axes[c.shape->axis];
  const float half = dot(towards, along) > 0.0F ? c.shape->half_length_m : -c.shape->half_length_m;
  return c.center + half * along + c.shape->radius_m * direction_across(along, towards);
}

// Whether the shape is a box, a capsule or a cylinder.
BROADSIDE_HD bool has_farthest_point(const ContactShape& s) {
  return s.kind == ContactKind::kBox || s.kind == ContactKind::kCapsule || s.kind == ContactKind::kCylinder;
}

// The point of a shape that has_farthest_point which is farthest along the unit direction n.
BROADSIDE_HD Vec3 farthest_point(const PlacedShape& p, Vec3 n) {
  if (p.shape->kind == ContactKind::kCylinder) return farthest_of_cylinder(p, n);
  if (p.shape->kind == ContactKind::kCapsule) {
    const Vec3 along = p.axes[p.shape->axis];
    const float half = dot(n, along) > 0.0F ? p.shape->half_length_m : -p.shape->half_length_m;
    return p.center + half * along + p.shape->radius_m * n;
  }
  const Vec3 local = turned_back(p.axes, n);
  const Vec3 half = p.shape->half;
  const Vec3 corner{local.x > 0.0F ? half.x : -half.x, local.y > 0.0F ? half.y : -half.y,
                    local.z > 0.0F ? half.z : -half.z};
  return p.center + turned(p.axes, corner);
}

// toward, stop_m, thin, slack_m: as for begin_search and search_on of hulls. Normals are in the axes of the world.
BROADSIDE_HD_CALLED HullGap round_gap(const PlacedShape& a, const PlacedShape& b, float stop_m, float thin,
                                      float slack_m, Vec3 toward = {}) {
  HullSearch search = begin_search_toward(dot(toward, toward) > 0.0F ? toward : a.center - b.center);
  search_by(search, stop_m, thin, slack_m, [&](const HullSearch& s) {
    const Vec3 between = farthest_point(a, -s.n) - farthest_point(b, s.n);
    return FarthestPoints{between, dot(s.n, between)};
  });
  search.gap.normal = search.best;
  return search.gap;
}

}  // namespace broadside::core

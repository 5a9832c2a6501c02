// A sphere against spheres, capsules, boxes, cylinders and hulls: one point, in closed form.
#pragma once

#include "core/attributes.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/point_nearest.hpp"

namespace broadside::core {

// A ball about `ball_center` (A) and a solid grown by solid_ball_m (B), whose distance from that center is given.
BROADSIDE_HD void ball_manifold(Vec3 ball_center, float ball_m, const PointDistance& distance, float solid_ball_m,
                                float reach_m, Manifold& out) {
  out.count = 0;
  const float gap = distance.gap_m - (ball_m + solid_ball_m);
  if (!(gap <= reach_m)) return;
  out.normal = distance.normal;
  // The ball's surface is ball_m towards B; halfway is half a gap further.
  keep_one(out, ball_center - (ball_m + 0.5F * gap) * distance.normal, gap, feature_key(0, distance.name));
}

BROADSIDE_HD void sphere_manifold(const PlacedShape& sphere, const PlacedShape& other, float rounding_m, float reach_m,
                                  Manifold& out) {
  const Vec3 p = sphere.center;
  const float ball = sphere.shape->radius_m;
  switch (other.shape->kind) {
    case ContactKind::kSphere:
      return ball_manifold(p, ball, point_to_point(p - other.center, rounding_m, 0), other.shape->radius_m, reach_m,
                           out);
    case ContactKind::kCapsule:
      return ball_manifold(p, ball, point_to_segment(other, p, rounding_m), other.shape->radius_m, reach_m, out);
    case ContactKind::kBox:
      return ball_manifold(p, ball, point_to_box(other, p, rounding_m), 0.0F, reach_m, out);
    case ContactKind::kCylinder:
      return ball_manifold(p, ball, point_to_cylinder(other, p, rounding_m), 0.0F, reach_m, out);
    case ContactKind::kHull:
      return ball_manifold(p, ball, point_to_hull(other, p, rounding_m), 0.0F, reach_m, out);
    default:
      out.count = 0;
  }
}

}  // namespace broadside::core

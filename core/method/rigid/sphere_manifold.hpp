// A sphere against spheres, capsules, boxes, cylinders and hulls: one point, in closed form.
#pragma once

#include "core/attributes.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/point_nearest.hpp"

namespace broadside::core {

BROADSIDE_HD_CALLED void sphere_manifold(const PlacedShape& sphere, const PlacedShape& other, float rounding_m,
                                         float reach_m, Manifold& out) {
  out.count = 0;
  const float ball = sphere.shape->radius_m;
  const PointDistance distance = point_to_solid(other, sphere.center, rounding_m);
  const float gap = distance.gap_m - ball;
  if (!(gap <= reach_m)) return;
  out.normal = distance.normal;
  // The sphere's surface is one radius from its center towards B; the middle is half a gap farther.
  keep_one(out, sphere.center - (ball + 0.5F * gap) * distance.normal, gap, feature_key(0, distance.name));
}

}  // namespace broadside::core

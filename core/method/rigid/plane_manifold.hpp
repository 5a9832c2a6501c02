// Any convex shape against a half-space: a face of the domain, or a static plane of any direction.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/contact.hpp"
#include "core/math/box.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/polytopes.hpp"

namespace broadside::core {

// Face k (0..5 for -x +x -y +y -z +z) of the domain, as the surface of a solid around the domain, and its pose.
BROADSIDE_HD ContactShape domain_face_shape(int face) {
  ContactShape out;
  out.kind = ContactKind::kHalfSpace;
  out.normal = axis_vector(face / 2, (face & 1) != 0 ? -1.0F : 1.0F);
  return out;
}
BROADSIDE_HD ContactPose domain_face_pose(const Box& domain, int face) {
  ContactPose out;
  out.x[face / 2] = (face & 1) != 0 ? domain.max[face / 2] : domain.min[face / 2];
  return out;
}

namespace plane_detail {

// The point halfway between a surface point and the plane below it.
BROADSIDE_HD ManifoldPoint over_plane(Vec3 on_surface, Vec3 normal, Vec3 on_plane, std::uint32_t name) {
  const float gap = dot(normal, on_surface - on_plane);
  return {on_surface - (0.5F * gap) * normal, gap, feature_key(name, face_name(0))};
}

// Corner k of eight around the lower (first) or upper end of a cylinder: along the body's axes, and halfway between
// them.
BROADSIDE_HD Vec3 rim_corner(const PlacedShape& c, bool is_upper, int k) {
  constexpr float kDiagonal = 0.70710678F;
  const int axis = c.shape->axis;
  const float u = k % 4 == 2 ? 0.0F : (k % 4 == 0 ? 1.0F : kDiagonal);
  const float w = k % 4 == 0 ? 0.0F : (k % 4 == 2 ? 1.0F : kDiagonal);
  const Vec3 out = (k > 2 && k < 6 ? -u : u) * c.axes[axis == 0 ? 1 : 0] + (k > 4 ? -w : w) * c.axes[axis == 2 ? 1 : 2];
  const float half = c.shape->half_length_m;
  return c.center + (is_upper ? half : -half) * c.axes[axis] + c.shape->radius_m * out;
}

// A lying cylinder rolls on the two ends of its lowest line. A standing one has the eight corners of its lower end,
// which turn with it, so that they keep their names. Where that end is tilted so far that its higher side is out of
// reach, its true lowest point is added, because the cylinder tips over the round rim.
BROADSIDE_HD void cylinder_over_plane(const PlacedShape& c, Vec3 n, Vec3 on_plane, float reach_m, Manifold& out) {
  const int axis = c.shape->axis;
  const Vec3 along = c.axes[axis];
  const float half = c.shape->half_length_m;
  const float radius = c.shape->radius_m;
  const float upright = dot(n, along);
  const float sine = length(upright * along - n);  // of the angle between axis and normal
  const bool stands = fabsf(upright) >= sine;
  const Vec3 lowest = radius * direction_across(along, -n);
  const bool is_upper = upright < 0.0F;
  const Vec3 end = c.center + (is_upper ? half : -half) * along;
  const bool is_all_round = dot(n, end - on_plane) + radius * sine <= reach_m;
  keep_four(out, stands ? 9 : 2, reach_m, [&](int k) {
    if (!stands) return over_plane(c.center + (k == 0 ? -half : half) * along + lowest, n, on_plane, corner_name(k));
    if (k == 8 && !is_all_round) return over_plane(end + lowest, n, on_plane, corner_name(is_upper ? 1 : 0));
    const int corner = k == 8 ? 0 : k;
    return over_plane(rim_corner(c, is_upper, corner), n, on_plane, corner_name(2 + corner + (is_upper ? 8 : 0)));
  });
}

}  // namespace plane_detail

template <typename Lanes>
BROADSIDE_HD_CALLED void plane_manifold(const PlacedShape& a, const PlacedShape& plane, float reach_m, Manifold& out) {
  const Vec3 n = turned(plane.axes, plane.shape->normal);
  const Vec3 on_plane = plane.center;
  out.count = 0;
  out.normal = n;
  const auto over = [&](Vec3 p, std::uint32_t name) { return plane_detail::over_plane(p, n, on_plane, name); };
  const auto corner = [&](int k) { return static_cast<std::uint32_t>(k); };
  if constexpr (Lanes::kKnowsLongShapes)
    if (a.shape->kind == ContactKind::kHull) {
      const HullPolytope hull = hull_polytope(a);
      return keep_four_near<Lanes>(
          out, hull.corner_count(), reach_m, kTurnOfStep, [&](int k) { return dot(n, hull.corner(k) - on_plane); },
          [&](int k) { return over(hull.corner(k), corner(k)); });
    }
  if constexpr (Lanes::kLeavesHardPairs) return;  // these lanes have only hulls
  switch (a.shape->kind) {
    case ContactKind::kSphere:
      return keep_four(out, 1, reach_m, [&](int) { return over(a.center - a.shape->radius_m * n, 0); });
    case ContactKind::kCapsule: {
      const SegmentPolytope segment = segment_polytope(a);
      return keep_four(out, 2, reach_m,
                       [&](int k) { return over(segment.corner(k) - a.shape->radius_m * n, corner(k)); });
    }
    case ContactKind::kBox: {
      // The four corners of the face that looks down; among them is the lowest one.
      const BoxPolytope box = box_polytope(a);
      const int face = box.support_face(-n);
      return keep_four(out, 4, reach_m, [&](int k) {
        const int c = box.face_corner(face, k);
        return over(box.corner(c), corner(c));
      });
    }
    case ContactKind::kCylinder:
      return plane_detail::cylinder_over_plane(a, n, on_plane, reach_m, out);
    default:
      break;
  }
}

}  // namespace broadside::core

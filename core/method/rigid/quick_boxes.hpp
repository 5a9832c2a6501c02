// Decisions about two boxes by one direction. Most pairs that may meet within a step do not, and one plane shows that
// without making their patches.
//
// The plane must separate the boxes at the start, where both end, and where one of them ends and the other one stays.
// Then it separates them on every way between these poses that does not turn: each body passes by on its own side.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/separating_axis.hpp"

namespace broadside::core {

BROADSIDE_HD bool are_boxes(const ContactShape& a, const ContactShape& b) {
  return a.kind == ContactKind::kBox && b.kind == ContactKind::kBox;
}

namespace quick_detail {

// How far a box reaches from its center along a direction.
BROADSIDE_HD float half_along(const TurnedAxes& axes, Vec3 half, Vec3 n) {
  const Vec3 d = turned_back(axes, n);
  return (fabsf(d.x) * half.x + fabsf(d.y) * half.y) + fabsf(d.z) * half.z;
}

}  // namespace quick_detail

// How far box A is above box B along a unit direction from B to A.
BROADSIDE_HD float gap_of_boxes(const ContactShape& shape_a, const ContactPose& pose_a, const ContactShape& shape_b,
                                const ContactPose& pose_b, Vec3 n) {
  const TurnedAxes a = turned_axes(pose_a.q);
  const TurnedAxes b = turned_axes(pose_b.q);
  const Vec3 d = (pose_a.x - pose_b.x) + (turned(a, shape_a.center) - turned(b, shape_b.center));
  return dot(n, d) - (quick_detail::half_along(a, shape_a.half, n) + quick_detail::half_along(b, shape_b.half, n));
}

// Whether the plane across n parts two boxes where both end, and where one of them ends and the other stays.
BROADSIDE_HD bool parts_ends(Vec3 n, const ContactShape& shape_a, const ContactPath& a, const ContactShape& shape_b,
                             const ContactPath& b) {
  return gap_of_boxes(shape_a, a.end, shape_b, b.end, n) > 0.0F &&
         gap_of_boxes(shape_a, a.end, shape_b, b.start, n) > 0.0F &&
         gap_of_boxes(shape_a, a.start, shape_b, b.end, n) > 0.0F;
}

// Whether two boxes have no patch at the start of a step, or only one that leads to no contact. near_m: a patch with a
// gap larger than this, whatever its normal, is too far to be kept for nearness alone (near_m of pushed_motion.hpp).
BROADSIDE_HD bool boxes_surely_pass(const ContactShape& shape_a, const ContactPath& a, const ContactShape& shape_b,
                                    const ContactPath& b, float reach_m, float near_m) {
  const PlacedShape start_a = placed_shape(shape_a, a.start, a.start.x);
  const PlacedShape start_b = placed_shape(shape_b, b.start, a.start.x);
  const SeparatingAxis axis = separating_axis_of_boxes(start_a, start_b, contact_rounding_m(start_a, start_b), reach_m);
  if (axis.gap_m > reach_m) return true;
  return axis.gap_m > near_m && axis.gap_m > 0.0F && parts_ends(axis.normal, shape_a, a, shape_b, b);
}

}  // namespace broadside::core

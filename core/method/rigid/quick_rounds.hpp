// Decisions about a cylinder and a box, a capsule or another cylinder by bounds of their distance, as quick_hulls.hpp
// has them for hulls. The patch of a cylinder takes some 700,000 operations, and most pairs that may meet within a step
// do not.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/pushed_motion.hpp"
#include "core/method/rigid/quick_hulls.hpp"
#include "core/method/rigid/round_gap.hpp"

namespace broadside::core {

BROADSIDE_HD bool has_round_answers(const ContactShape& a, const ContactShape& b) {
  const bool has_cylinder = a.kind == ContactKind::kCylinder || b.kind == ContactKind::kCylinder;
  return has_cylinder && has_farthest_point(a) && has_farthest_point(b);
}

// As hull_bounds.
BROADSIDE_HD_CALLED HullBounds round_bounds(const ContactShape& shape_a, const ContactPose& pose_a,
                                            const ContactShape& shape_b, const ContactPose& pose_b, float stop_m,
                                            Vec3 toward = {}) {
  const PlacedShape a = placed_shape(shape_a, pose_a, pose_a.x);
  const PlacedShape b = placed_shape(shape_b, pose_b, pose_a.x);
  const float rounding_m = contact_rounding_m(a, b);
  return {round_gap(a, b, stop_m + quick_detail::kMargin * rounding_m, quick_detail::kThin, rounding_m, toward),
          rounding_m};
}

// As surely_pass of two hulls.
BROADSIDE_HD bool rounds_surely_pass(const ContactShape& shape_a, const ContactPath& a, const ContactShape& shape_b,
                                     const ContactPath& b, float reach_m, const NearReach& near) {
  const auto bounds_at = [&](const ContactPose& at_a, const ContactPose& at_b, float stop_m, Vec3 toward) {
    return round_bounds(shape_a, at_a, shape_b, at_b, stop_m, toward);
  };
  return quick_detail::surely_pass(round_bounds(shape_a, a.start, shape_b, b.start, reach_m), a, b, reach_m, near,
                                   bounds_at);
}

}  // namespace broadside::core

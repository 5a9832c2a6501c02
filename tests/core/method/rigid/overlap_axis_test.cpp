// The axis found for two finely cut hulls that overlap is the narrowest there is, whatever axes the search left out. It
// is compared with the exact depth, which tries every axis.
#include "core/method/rigid/overlap_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/method/rigid/near_bound.hpp"
#include "tests/core/method/rigid/manifold_cases.hpp"

namespace broadside::core {
namespace {

// A pebble, a coin or a needle.
Subject hull_of_any_form(Draw& draw) {
  const Vec3 halves[] = {{0.5F, 0.4F, 0.35F}, {0.5F, 0.45F, 0.01F}, {0.5F, 0.02F, 0.015F}};
  return cut_ellipsoid(draw, halves[draw.below(3)], 60);
}

// Moves b along the normal of the distance until both overlap by wanted_m, or by nearly as much.
void overlap_by(float wanted_m, const Subject& a, Subject& b) {
  for (int step = 0; step < 3; ++step) {
    const exact::SignedDistance now = exact::signed_distance(a.placed(), b.placed());
    const auto by_m = static_cast<float>(now.distance_m + static_cast<double>(wanted_m));
    b.pose.x = b.pose.x + by_m * Vec3{static_cast<float>(now.normal.x), static_cast<float>(now.normal.y),
                                      static_cast<float>(now.normal.z)};
  }
}

TEST(OverlapAxis, IsTheNarrowestOfAll) {
  Draw draw(47);
  int told = 0;
  int shallow = 0;
  int of_kind[4] = {};
  for (int trial = 0; trial < 150; ++trial) {
    const Subject a = hull_of_any_form(draw);
    Subject b = hull_of_any_form(draw);
    b.pose.x = 1.2F * normalized(draw.in_cube(1.0F));
    float wanted_m = 0.1F;
    for (int k = trial % 10; k > 0; --k) wanted_m *= 0.25F;
    overlap_by(wanted_m, a, b);
    const double depth_m = -exact::signed_distance(a.placed(), b.placed()).distance_m;
    const PlacedShape placed_a = placed_shape(a.shape, a.pose, a.pose.x);
    const PlacedShape placed_b = placed_shape(b.shape, b.pose, a.pose.x);
    const float rounding_m = contact_rounding_m(placed_a, placed_b);
    const HullPolytope hull_a = hull_polytope<OneLane>(placed_a);
    const HullPolytope hull_b = hull_polytope<OneLane>(placed_b);
    SeparatingAxis axis;
    if (!overlap_axis(hull_a, hull_b, nearest_of(hull_a, hull_b, rounding_m), rounding_m, axis)) continue;
    ++told;
    shallow += depth_m < 1e-3 ? 1 : 0;
    ++of_kind[static_cast<int>(axis.kind)];
    EXPECT_NEAR(length(axis.normal), 1.0F, 1e-6F);
    EXPECT_NEAR(-axis.gap_m, depth_m, 2.0F * rounding_m) << trial;
    const double along_m = exact::overlap_along(a.placed(), b.placed(), exact::to_point(axis.normal));
    EXPECT_NEAR(along_m, depth_m, 2.0F * rounding_m) << "the normal is not that of the depth, trial " << trial;
    EXPECT_TRUE(axis.kind != AxisKind::kFaceOfA || axis.face_of_a == axis.of_a) << trial;
    EXPECT_TRUE(axis.kind != AxisKind::kFaceOfB || axis.face_of_b == axis.of_b) << trial;
    if (axis.kind != AxisKind::kEdges) continue;
    const auto rise = [&](const HullPolytope& hull, const int* ends) {
      return std::abs(dot(axis.normal, hull.corner(ends[0]) - hull.corner(ends[1])));
    };
    EXPECT_LE(rise(hull_a, axis.ends_of_a), rounding_m) << "the axis is not across the edge of A, trial " << trial;
    EXPECT_LE(rise(hull_b, axis.ends_of_b), rounding_m) << "the axis is not across the edge of B, trial " << trial;
  }
  EXPECT_GT(told, 100);
  EXPECT_GT(shallow, 60);
  for (const AxisKind kind : {AxisKind::kFaceOfA, AxisKind::kFaceOfB, AxisKind::kEdges})
    EXPECT_GT(of_kind[static_cast<int>(kind)], 15);
}

TEST(OverlapAxis, IsNotToldOfHullsThatAreApart) {
  Draw draw(48);
  const Subject a = hull_of_any_form(draw);
  Subject b = hull_of_any_form(draw);
  b.pose.x = {3.0F, 0.0F, 0.0F};
  const PlacedShape placed_a = placed_shape(a.shape, a.pose, a.pose.x);
  const PlacedShape placed_b = placed_shape(b.shape, b.pose, a.pose.x);
  const HullPolytope hull_a = hull_polytope<OneLane>(placed_a);
  const HullPolytope hull_b = hull_polytope<OneLane>(placed_b);
  SeparatingAxis axis;
  EXPECT_FALSE(overlap_axis(hull_a, hull_b, nearest_of(hull_a, hull_b, 1e-6F), 1e-6F, axis));
}

}  // namespace
}  // namespace broadside::core

// For two finely cut hulls that are apart, the manifold is that of their nearest points, however near they are.
#include "core/method/rigid/hull_manifold.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/method/rigid/passing_by.hpp"
#include "tests/core/method/rigid/manifold_cases.hpp"

namespace broadside::core {
namespace {

Subject pebble(Draw& draw, int corners) {
  const Vec3 half{draw.between(0.35F, 0.5F), draw.between(0.35F, 0.5F), draw.between(0.35F, 0.5F)};
  return cut_ellipsoid(draw, half, corners);
}

HullPolytope polytope_of(const Subject& s, Vec3 origin) {
  return hull_polytope<OneLane>(placed_shape(s.shape, s.pose, origin));
}

// From 0.3 m down to a micrometer.
TEST(HullManifold, DeepestPointHasTheDistance) {
  Draw draw(31);
  int by_points = 0;
  int by_faces = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Subject a = pebble(draw, 60);
    Subject b = pebble(draw, 60);
    b.pose.x = 1.5F * normalized(draw.in_cube(1.0F));
    float wanted_m = 0.3F;
    for (int k = trial % 10; k > 0; --k) wanted_m *= 0.25F;
    // Along the normal of the distance, which it shortens by as much.
    const exact::SignedDistance far = exact::signed_distance(a.placed(), b.placed());
    const auto by_m = static_cast<float>(far.distance_m - wanted_m);
    b.pose.x = b.pose.x + by_m * Vec3{static_cast<float>(far.normal.x), static_cast<float>(far.normal.y),
                                      static_cast<float>(far.normal.z)};
    const double truth = exact::signed_distance(a.placed(), b.placed()).distance_m;
    const PlacedShape placed_a = placed_shape(a.shape, a.pose, a.pose.x);
    const PlacedShape placed_b = placed_shape(b.shape, b.pose, a.pose.x);
    const float rounding_m = contact_rounding_m(placed_a, placed_b);
    Manifold found[kPatchesOfPair];
    ASSERT_EQ(make_manifolds(a.shape, a.pose, b.shape, b.pose, 1.0F, found), 1) << trial;
    EXPECT_NEAR(length(found[0].normal), 1.0F, 1e-6F);
    EXPECT_NEAR(least_gap_m(found[0]), truth, 3.0F * rounding_m) << trial;
    const double along = -exact::overlap_along(a.placed(), b.placed(), exact::to_point(found[0].normal));
    EXPECT_NEAR(along, truth, 3.0F * rounding_m) << "the normal is not that of the distance, trial " << trial;

    const HullPolytope hull_a = polytope_of(a, a.pose.x);
    const HullPolytope hull_b = polytope_of(b, a.pose.x);
    const NearestOfHulls near = nearest_of(hull_a, hull_b, rounding_m);
    if (!hull_detail::are_clearly_apart(near, rounding_m)) continue;
    const NearestPoints points = hull_detail::points_of(hull_a, hull_b, near.corners);
    EXPECT_NEAR(length(points.on_a - points.on_b), truth, 2.0F * rounding_m) << trial;
    const SeparatingAxis axis = hull_detail::axis_near(hull_a, hull_b, near.gap.normal, near.gap.least_m, rounding_m);
    const SeparatingAxis tried = separating_axis(hull_a, hull_b, rounding_m, 1.0F);
    EXPECT_GE(axis.gap_m, tried.gap_m - 3.0F * rounding_m) << "an axis of faces or edges is wider, trial " << trial;
    ++(axis.kind == AxisKind::kPoints ? by_points : by_faces);
  }
  EXPECT_GT(by_points, 50);
  EXPECT_GT(by_faces, 25);
}

TEST(HullManifold, NamesAFeatureByItsCorners) {
  const std::uint32_t same[] = {7, 7, 7};
  const std::uint32_t edge[] = {7, 9, 7};
  const std::uint32_t back[] = {9, 9, 7};
  const std::uint32_t face[] = {7, 9, 4};
  const std::uint32_t turned[] = {4, 7, 9};
  EXPECT_EQ(hull_detail::name_of(same, 3), corner_name(7));
  EXPECT_EQ(hull_detail::name_of(edge, 3), edge_name(7, 9));
  EXPECT_EQ(hull_detail::name_of(back, 3), edge_name(7, 9));
  EXPECT_EQ(hull_detail::name_of(face, 3), hull_detail::name_of(turned, 3));
  EXPECT_NE(hull_detail::name_of(face, 3), hull_detail::name_of(face, 2));
}

}  // namespace
}  // namespace broadside::core

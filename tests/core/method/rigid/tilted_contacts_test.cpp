// Points of round hulls: where a tilt would make them touch, on both surfaces, and apart from each other.
#include "core/method/rigid/tilted_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/exact/convex_hull.hpp"
#include "tests/core/method/rigid/manifold_cases.hpp"

namespace broadside::core {
namespace {

// Flattened to a third, so that two of them rest on each other with much of their surface nearby.
Subject pebble(Draw& draw) {
  std::vector<Vec3> points;
  for (int k = 0; k < 80; ++k) {
    const Vec3 p = normalized(draw.in_cube(1.0F));
    points.push_back({0.6F * p.x, 0.2F * p.y, 0.6F * p.z});
  }
  return hull(*exact::convex_hull(points));
}

double off_surface(const Subject& s, Vec3 x) {
  exact::ConvexCore point;
  point.vertices = {exact::to_point(x)};
  return std::abs(exact::signed_distance(point, s.placed()).distance_m);
}

TEST(TiltedContacts, LieOnBothSurfacesAndApart) {
  Draw draw(5);
  int spread = 0;
  constexpr int kTrials = 60;
  for (int trial = 0; trial < kTrials; ++trial) {
    Subject a = pebble(draw);
    const Subject b = pebble(draw);
    ASSERT_GT(a.shape.hull.edge_count * b.shape.hull.edge_count, 4096U) << "these are no round hulls";
    a.pose.x = {draw.between(-0.05F, 0.05F), 0.42F, draw.between(-0.05F, 0.05F)};
    a.pose.q = {0.0F, 0.0F, 1.0F, 0.0F};
    Manifold m[kPatchesOfPair];
    ASSERT_EQ(make_manifolds(a.shape, a.pose, b.shape, b.pose, 0.2F, m), 1);
    float farthest = 0.0F;
    for (int k = 0; k < m[0].count; ++k) {
      const ManifoldPoint& p = m[0].points[k];
      const Vec3 half = (0.5F * p.gap_m) * m[0].normal;
      EXPECT_LT(off_surface(a, a.pose.x + (p.point + half)), 1e-5) << trial << " point " << k;
      EXPECT_LT(off_surface(b, a.pose.x + (p.point - half)), 1e-5) << trial << " point " << k;
      for (int i = 0; i < k; ++i) farthest = std::max(farthest, length(p.point - m[0].points[i].point));
    }
    // The faces of a pebble are a tenth of a meter; before, so far apart were the points.
    if (farthest > 0.25F) ++spread;
  }
  EXPECT_GT(spread, kTrials * 3 / 4);
}

}  // namespace
}  // namespace broadside::core

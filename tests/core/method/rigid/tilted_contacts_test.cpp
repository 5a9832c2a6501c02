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

// The height of the surface along a line, from all planes: that of the lowest plane that faces up.
double height_by_planes(const Subject& s, Vec3 x, Vec3 up, double& below) {
  const PlacedShape placed = placed_shape(s.shape, s.pose, s.pose.x);
  double entry = -1e30;
  below = 1e30;
  for (std::uint32_t f = 0; f < s.shape.hull.face_count; ++f) {
    const exact::Point n = exact::to_point(turned(placed.axes, s.shape.hull.faces[f].normal));
    const double outside = dot(n, exact::to_point(x)) - static_cast<double>(s.shape.hull.faces[f].offset_m);
    const double along = dot(n, exact::to_point(up));
    if (along > 0.0) entry = std::max(entry, outside / along);
    if (along < 0.0) below = std::min(below, outside / along);
  }
  return entry;
}

TEST(TiltedContacts, HeightsAreThoseOfTheSurface) {
  Draw draw(6);
  int over = 0;
  int missed = 0;
  int left_out = 0;
  for (int trial = 0; trial < 40; ++trial) {
    Subject s = pebble(draw);
    s.pose.q = draw.turn();
    const PlacedShape placed = placed_shape(s.shape, s.pose, s.pose.x);
    const auto hull = hull_polytope(placed);
    for (int k = 0; k < 50; ++k) {
      const Vec3 up = normalized(draw.in_cube(1.0F));
      const Vec3 x = draw.in_cube(0.6F);
      double below = 0.0;
      const double truth = height_by_planes(s, x, up, below);
      // A line that passes the rim at less than this distance may count as inside or outside.
      if (std::abs(truth - below) < 1e-4) continue;
      float height = 0.0F;
      const int face = tilt_detail::face_below(hull, hull.support_face(up), x, up, 1e-6F, 1e3F);
      EXPECT_EQ(face >= 0, truth <= below) << trial << " line " << k;
      if (face < 0) {
        ++missed;
      } else if (height_above(hull, hull.support_face(up), x, up, 1e-6F, 1e3F, height)) {
        ++over;
        EXPECT_NEAR(height, truth, 1e-5) << trial << " line " << k;
        // A caller that asks for low points alone gets the same points with the same bits.
        const float most_m = draw.between(-0.3F, 0.3F);
        float low = 0.0F;
        const bool is_told = height_above(hull, hull.support_face(up), x, up, 1e-6F, most_m, low);
        if (height <= most_m) {
          EXPECT_TRUE(is_told) << trial << " line " << k;
          EXPECT_EQ(low, height) << trial << " line " << k;
        }
        left_out += is_told ? 0 : 1;
      }
    }
  }
  EXPECT_GT(over, 200);
  EXPECT_GT(missed, 200);
  EXPECT_GT(left_out, 50);
}

// A flat side with many corners is stored as several faces of one plane: for a line beyond it, the search has to cross
// all of them.
TEST(TiltedContacts, FlatSidesOfManyCornersAreCrossed) {
  std::vector<Vec3> points;
  for (int k = 0; k < 60; ++k) {
    const double angle = 0.1047197551196598 * k;
    const auto c = static_cast<float>(std::cos(angle));
    const auto w = static_cast<float>(std::sin(angle));
    points.push_back({c, 0.5F, w});
    points.push_back({1.5F * c, 0.0F, 1.5F * w});
    points.push_back({c, -0.5F, w});
  }
  const Subject s = hull(*exact::convex_hull(points));
  const auto placed = hull_polytope(placed_shape(s.shape, s.pose, s.pose.x));
  const Vec3 up{0.0F, 1.0F, 0.0F};
  for (int k = 0; k < 100; ++k) {
    const double angle = 0.37 * k;
    const float radius = 0.0147F * static_cast<float>(k);
    const Vec3 x{radius * static_cast<float>(std::cos(angle)), 0.7F, radius * static_cast<float>(std::sin(angle))};
    float height = 0.0F;
    const bool is_over = height_above(placed, placed.support_face(up), x, up, 1e-6F, 1e3F, height);
    if (radius < 0.99F) {
      ASSERT_TRUE(is_over) << radius;
      EXPECT_NEAR(height, 0.2F, 1e-5) << radius;
    } else if (radius > 1.01F && radius < 1.48F) {
      // The slope falls by 1 m a meter; its facets are flat between corners 3 degrees to either side.
      ASSERT_TRUE(is_over) << radius;
      EXPECT_NEAR(height, 0.2F + (radius - 1.0F), 3e-3) << radius;
    }
  }
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
    // Twice the size of a pebble's faces; before, points were only as far apart as one face is large.
    if (farthest > 0.2F) ++spread;
  }
  EXPECT_GT(spread, kTrials * 3 / 4);
}

}  // namespace
}  // namespace broadside::core

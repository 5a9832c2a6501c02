// Hulls against known properties: closed, no point outside, the volume of a box. Also surfaces that cross themselves.
#include "core/exact/convex_hull.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/exact/self_crossing.hpp"
#include "core/mesh/topology.hpp"
#include "core/scene/primitive.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::tests {
namespace {

TEST(ConvexHull, OfPointsInABoxIsTheBox) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> in(-0.5F, 0.5F);
  std::vector<core::Vec3> points;
  for (int k = 0; k < 500; ++k) points.push_back({in(random), 2.0F * in(random), 3.0F * in(random)});
  for (unsigned corner = 0; corner < 8; ++corner)
    points.push_back(
        {(corner & 1U) != 0 ? 0.5F : -0.5F, (corner & 2U) != 0 ? 1.0F : -1.0F, (corner & 4U) != 0 ? 1.5F : -1.5F});
  const auto hull = exact::convex_hull(points);
  ASSERT_TRUE(hull.has_value());
  EXPECT_EQ(hull->triangles.size(), 12U);
  EXPECT_NEAR(core::signed_volume_m3(*hull), 6.0, 1e-12);
}

TEST(ConvexHull, OfRandomPointsIsClosedAndConvexAndNothingIsOutside) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> in(-1.0F, 1.0F);
    std::vector<core::Vec3> points;
    for (int k = 0; k < 200; ++k) points.push_back({in(random), in(random), in(random)});
    const auto hull = exact::convex_hull(points);
    ASSERT_TRUE(hull.has_value()) << seed;
    EXPECT_TRUE(core::topology(*hull).is_closed()) << seed;
    // Looks at every given point, also those that no triangle uses.
    EXPECT_TRUE(core::is_convex(*hull)) << seed;
  }
}

TEST(ConvexHull, APlaneHasNone) {
  EXPECT_FALSE(exact::convex_hull({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0.5F, 0.25F, 1}}).has_value());
  EXPECT_FALSE(exact::convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).has_value());
}

TEST(SelfCrossing, ABallDoesNotAndOneWithAVertexPulledThroughDoes) {
  core::Mesh ball = datasets::sphere_mesh(1.0, 6).value();
  EXPECT_FALSE(exact::crosses_itself(ball));
  ball.vertices[40] = -1.5F * ball.vertices[40];
  EXPECT_TRUE(exact::crosses_itself(ball));
}

}  // namespace
}  // namespace broadside::tests

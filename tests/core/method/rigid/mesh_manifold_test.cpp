// Meshes: a convex one has the distance that the exact arbiter gives its solid; floors, notches and planes have the
// contacts that can be said by hand.
#include "core/method/rigid/mesh_manifold.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/method/rigid/mesh_cases.hpp"

namespace broadside::core {
namespace {

TEST(Meshes, ThatAreConvexAreAsFarApartAsTheirSolids) {
  Draw draw(1);
  for (int trial = 0; trial < 200; ++trial) {
    Subject a = trial % 3 == 0 ? sphere(0.4F) : (trial % 3 == 1 ? box({0.5F, 0.4F, 0.3F}) : capsule(0.2F, 0.5F, 1));
    MeshBody mesh(random_hull(draw));
    Subject b = hull(mesh.mesh);
    a.pose = {draw.in_cube(1.0F), draw.turn()};
    b.pose.q = draw.turn();
    place_apart(a, b, normalized(draw.in_cube(1.0F)), draw.between(1e-3F, 0.05F));
    const double truth = exact::signed_distance(a.placed(), b.placed()).distance_m;
    Manifold m[kPatchesOfPair];
    const int count = make_manifolds(a.shape, a.pose, mesh.shape, b.pose, 0.1F, m);
    ASSERT_GE(count, 1) << "trial " << trial;
    // Twice of a polytope's: the axis between a triangle and the body, and where its sides are.
    const double rounding = 6.0 * rounding_of(a, b);
    EXPECT_NEAR(deepest(m, count), truth, rounding) << "trial " << trial;
    EXPECT_NEAR(-exact::overlap_along(a.placed(), b.placed(), exact::to_point(m[0].normal)), truth, rounding) << trial;
    Manifold back[kPatchesOfPair];
    const int count_back = make_manifolds(mesh.shape, b.pose, a.shape, a.pose, 0.1F, back);
    ASSERT_GE(count_back, 1);
    EXPECT_NEAR(deepest(back, count_back), truth, rounding);
    EXPECT_NEAR(dot(back[0].normal, m[0].normal), -1.0F, 1e-3F);
  }
}

// Balls and capsules whose middle is outside: the depth is what is left of the radius.
TEST(Meshes, BallsAreAsDeepInThemAsInTheirSolids) {
  Draw draw(7);
  for (int trial = 0; trial < 200; ++trial) {
    Subject a = trial % 2 == 0 ? sphere(0.4F) : capsule(0.2F, 0.5F, trial % 3);
    MeshBody mesh(random_hull(draw));
    Subject b = hull(mesh.mesh);
    a.pose = {draw.in_cube(1.0F), draw.turn()};
    b.pose.q = draw.turn();
    const double wanted = draw.between(-0.9F * a.shape.radius_m, -1e-3F);
    place_apart(a, b, normalized(draw.in_cube(1.0F)), wanted);
    const double truth = exact::signed_distance(a.placed(), b.placed()).distance_m;
    Manifold m[kPatchesOfPair];
    const int count = make_manifolds(a.shape, a.pose, mesh.shape, b.pose, 0.1F, m);
    ASSERT_GE(count, 1) << "trial " << trial;
    const double rounding = 6.0 * rounding_of(a, b);
    EXPECT_NEAR(deepest(m, count), truth, rounding) << "trial " << trial;
    EXPECT_NEAR(-exact::overlap_along(a.placed(), b.placed(), exact::to_point(m[0].normal)), truth, rounding) << trial;
  }
}

TEST(Meshes, ABoxOnAFlatFloorHasItsFourCornersAndNothingOfInnerEdges) {
  MeshBody floor(floor_mesh());
  Draw draw(2);
  for (int trial = 0; trial < 50; ++trial) {
    Subject cube = box({0.3F, 0.2F, 0.4F});
    const float turn = draw.between(0.0F, 3.0F);
    cube.pose.q = {std::cos(0.5F * turn), 0.0F, std::sin(0.5F * turn), 0.0F};
    const float depth = draw.between(-0.004F, 0.004F);
    cube.pose.x = {draw.between(-1.0F, 1.0F), 0.2F - depth, draw.between(-1.0F, 1.0F)};
    Manifold m[kPatchesOfPair];
    ASSERT_EQ(make_manifolds(cube.shape, cube.pose, floor.shape, floor.pose, 0.01F, m), 1) << "trial " << trial;
    ASSERT_EQ(m[0].count, 4);
    EXPECT_NEAR(m[0].normal.y, 1.0F, 1e-6F);
    double reach = 0.0;
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(m[0].points[k].gap_m, -depth,
                  3.0F * contact_rounding_m(placed_shape(cube.shape, cube.pose, {}),
                                            placed_shape(floor.shape, floor.pose, {})));
      reach += std::hypot(m[0].points[k].point.x, m[0].points[k].point.z);
    }
    // Corners are 0.5 m from the middle. The deepest of points that are level is one of rounding's choice, which may
    // lie on an edge; the other three are then corners.
    EXPECT_GT(reach, 3.0 * 0.5) << "trial " << trial;
  }
}

// An L: a floor and a wall, closed.
Mesh notch_mesh() {
  Mesh mesh;
  for (const float z : {-1.0F, 1.0F})
    for (const Vec3 v : {Vec3{-1, -1, 0}, Vec3{1, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 1, 0}, Vec3{-1, 1, 0}})
      mesh.vertices.push_back({v.x, v.y, z});
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t k = 0; k < 6; ++k) quad(k, (k + 1) % 6, (k + 1) % 6 + 6, k + 6);
  quad(9, 10, 11, 6);
  quad(9, 6, 7, 8);
  quad(3, 0, 5, 4);
  quad(3, 2, 1, 0);
  return mesh;
}

TEST(Meshes, ANotchTouchesABoxFromTwoSides) {
  MeshBody notch(notch_mesh());
  Subject cube = box({0.3F, 0.3F, 0.3F});
  cube.pose.x = {0.301F, 0.299F, 0.0F};
  Manifold m[kPatchesOfPair];
  ASSERT_EQ(make_manifolds(cube.shape, cube.pose, notch.shape, notch.pose, 0.01F, m), 2);
  EXPECT_NEAR(m[0].normal.y, 1.0F, 1e-6F) << "the floor is deeper";
  EXPECT_NEAR(m[1].normal.x, 1.0F, 1e-6F);
  EXPECT_EQ(m[0].count, 4);
  EXPECT_EQ(m[1].count, 4);
  EXPECT_NEAR(deepest(m, 1), -0.001F, 1e-6F);
  EXPECT_NEAR(deepest(m + 1, 1), 0.001F, 1e-6F);
}

TEST(Meshes, OverAPlaneHaveTheirLowestCorners) {
  MeshBody notch(notch_mesh());
  notch.pose = {{3.0F, 0.999F, 0.0F}, {}};
  const ContactPose ground = domain_face_pose({{-10, 0, -10}, {10, 10, 10}}, 2);
  Manifold m[kPatchesOfPair];
  ASSERT_EQ(make_manifolds(notch.shape, notch.pose, domain_face_shape(2), ground, 0.01F, m), 1);
  ASSERT_EQ(m[0].count, 4);
  EXPECT_EQ(m[0].normal, (Vec3{0, 1, 0}));
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(m[0].points[k].gap_m, -0.001F, 1e-6F);
    EXPECT_EQ(std::abs(m[0].points[k].point.x), 1.0F);
    EXPECT_EQ(std::abs(m[0].points[k].point.z), 1.0F);
  }
}

TEST(Meshes, AMeshInTheNotchOfAnother) {
  MeshBody notch(notch_mesh());
  MeshBody cube(box_mesh({0.3F, 0.3F, 0.3F}));
  cube.pose.x = {0.3005F, 0.3002F, 0.1F};
  Manifold m[kPatchesOfPair];
  ASSERT_EQ(make_manifolds(cube.shape, cube.pose, notch.shape, notch.pose, 0.001F, m), 2);
  EXPECT_NEAR(m[0].normal.y, 1.0F, 1e-6F);
  EXPECT_NEAR(m[1].normal.x, 1.0F, 1e-6F);
  EXPECT_NEAR(deepest(m, 1), 0.0002F, 1e-6F);
  EXPECT_NEAR(deepest(m + 1, 1), 0.0005F, 1e-6F);
}

}  // namespace
}  // namespace broadside::core

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/convex_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"
#include "tests/core/mesh/mesh_topology.hpp"

namespace broadside {
namespace {

using datasets::box_mesh;
using datasets::lumpy_mesh;
using datasets::sphere_mesh;

TEST(BoxMesh, IsClosedWithTheVolumeAndCountsOfItsFormula) {
  const auto made = box_mesh({4.0, 0.5, 1.0}, {8, 2, 3});
  ASSERT_TRUE(made.ok()) << made.error().line();
  const core::Mesh& mesh = made.value();
  const int cells = 8 * 2 + 2 * 3 + 3 * 8;
  EXPECT_EQ(mesh.vertices.size(), 2U * cells + 2U);
  EXPECT_EQ(mesh.triangles.size(), 4U * cells);
  EXPECT_TRUE(tests::is_closed(mesh));
  // Lattice points at thirds of 1 m are rounded to float (half an ulp of 0.5 is 2^-25), on faces of at most 4 m^2.
  EXPECT_NEAR(tests::volume_m3(mesh), 4.0 * 0.5 * 1.0, 9.0 * 0x1p-25);
  EXPECT_EQ(core::bounds(mesh), (core::Box{{-2.0F, -0.25F, -0.5F}, {2.0F, 0.25F, 0.5F}}));
}

TEST(SphereMesh, IsClosedAndItsVerticesLieOnTheSphere) {
  for (const int f : {1, 2, 3, 8}) {
    SCOPED_TRACE(f);
    const auto made = sphere_mesh(2.0, f);
    ASSERT_TRUE(made.ok());
    const core::Mesh& mesh = made.value();
    EXPECT_EQ(mesh.vertices.size(), 10U * f * f + 2U);
    EXPECT_EQ(mesh.triangles.size(), 20U * f * f);
    EXPECT_TRUE(tests::is_closed(mesh));
    EXPECT_EQ(tests::euler_characteristic(mesh), 2);
    for (const core::Vec3 v : mesh.vertices)
      // Three coordinates below 2, each off by at most half an ulp (2^-24): sqrt(3) 2^-24, and double's rounding.
      EXPECT_NEAR(std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z), 2.0, 2.0 * 0x1p-23);
  }
  // The icosahedron of circumradius R: edge R / sin(2 pi / 5), volume 5 (3 + sqrt 5) / 12 edge^3.
  const double edge = 2.0 / std::sin(2.0 * std::numbers::pi / 5.0);
  EXPECT_NEAR(tests::volume_m3(sphere_mesh(2.0, 1).value()), 5.0 * (3.0 + std::sqrt(5.0)) / 12.0 * edge * edge * edge,
              1e-5);
  // Inscribed and converging to the ball from below; the deficit falls as 1 / f^2.
  const double ball = 4.0 / 3.0 * std::numbers::pi * 8.0;
  const double deficit8 = ball - tests::volume_m3(sphere_mesh(2.0, 8).value());
  const double deficit16 = ball - tests::volume_m3(sphere_mesh(2.0, 16).value());
  EXPECT_GT(deficit16, 0.0);
  EXPECT_NEAR(deficit8 / deficit16, 4.0, 0.1);
}

TEST(LumpyMesh, IsClosedOutwardSeededAndNotASphere) {
  const core::Mesh mesh = lumpy_mesh(4968, 1).value();
  EXPECT_EQ(mesh.triangles.size(), 5120U);  // 20 * 16^2; 20 * 15^2 = 4500 is farther
  EXPECT_TRUE(tests::is_closed(mesh));
  double least = 1e9;
  double most = 0.0;
  for (const core::Vec3 v : mesh.vertices) {
    least = std::min(least, double{core::length(v)});
    most = std::max(most, double{core::length(v)});
  }
  EXPECT_GT(most, 1.2 * least);
  // Star-shaped: every triangle sees the origin from its inner side, so it cannot cross another.
  for (const core::Triangle& t : mesh.triangles) {
    core::Mesh one;
    one.vertices = mesh.vertices;
    one.triangles = {t};
    ASSERT_GT(tests::volume_m3(one), 0.0);
    if (t[0] > 200) break;  // one triangle copies all vertices, so a sample is enough
  }
  EXPECT_EQ(lumpy_mesh(4968, 1).value().vertices, mesh.vertices);
  EXPECT_NE(lumpy_mesh(4968, 2).value().vertices, mesh.vertices);
}

// Three corners have two faces, front and back, which Euler's formula for closed bodies would let pass.
TEST(ConvexMesh, NeedsFourCorners) {
  EXPECT_TRUE(datasets::convex_mesh({1, 1, 1}, 4, 1).ok());
  EXPECT_FALSE(datasets::convex_mesh({1, 1, 1}, 3, 1).ok());
  EXPECT_FALSE(datasets::convex_mesh({1, 1, 1}, 65, 1).ok());
  EXPECT_FALSE(datasets::convex_mesh({1, 0, 1}, 8, 1).ok());
}

TEST(Shapes, RefuseWhatHasNoShape) {
  EXPECT_FALSE(box_mesh({1.0, 0.0, 1.0}, {1, 1, 1}).ok());
  EXPECT_FALSE(box_mesh({1.0, 1.0, std::numeric_limits<double>::quiet_NaN()}, {1, 1, 1}).ok());
  EXPECT_FALSE(box_mesh({1.0, 1.0, 1.0}, {1, 0, 1}).ok());
  EXPECT_FALSE(sphere_mesh(-1.0, 4).ok());
  EXPECT_FALSE(sphere_mesh(1.0, 0).ok());
  EXPECT_FALSE(lumpy_mesh(0, 1).ok());
  EXPECT_FALSE(lumpy_mesh(1'000'000'000, 1).ok());
}

}  // namespace
}  // namespace broadside

// The arbiter's own law: two points are the nearest of two convex bodies exactly when each lies in its body and the
// plane through it, across the line between them, has its whole body behind it. This certificate needs no second
// implementation. Meshes: the least distance over their triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/exact/triangle_distance.hpp"
#include "core/exact/triangle_tree.hpp"

namespace broadside::exact {
namespace {

// Double's rounding, 1.1e-16, times coordinates of up to 4 m, some tens of operations, and the squares that the
// barycentric coordinates of a flat triangle (height down to 1e-2 of its length) divide by.
constexpr double kTolerance = 1e-10;

double norm(Point a) {
  return std::sqrt(dot(a, a));
}

double distance_to_segment(Point p, Point a, Point b) {
  const Point u = b - a;
  const double t = dot(u, u) > 0.0 ? std::clamp(dot(p - a, u) / dot(u, u), 0.0, 1.0) : 0.0;
  return norm(p - (a + t * u));
}

// By barycentric coordinates; by its sides where its area is nearly zero.
bool lies_in(Point p, const Corners& t) {
  for (int k = 0; k < 3; ++k)
    if (distance_to_segment(p, t[k], t[(k + 1) % 3]) < kTolerance) return true;
  const Point u = t[1] - t[0];
  const Point v = t[2] - t[0];
  const Point w = p - t[0];
  const double determinant = dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v);
  if (!(determinant > 1e-12)) return false;
  const double s = (dot(w, u) * dot(v, v) - dot(w, v) * dot(u, v)) / determinant;
  const double r = (dot(w, v) * dot(u, u) - dot(w, u) * dot(u, v)) / determinant;
  return s > -kTolerance && r > -kTolerance && s + r < 1.0 + kTolerance && norm(w - (s * u + r * v)) < kTolerance;
}

testing::AssertionResult is_certified(const Corners& a, const Corners& b, const Nearest& found) {
  if (!lies_in(found.on_a, a)) return testing::AssertionFailure() << "the first point is not in its triangle";
  if (!lies_in(found.on_b, b)) return testing::AssertionFailure() << "the second point is not in its triangle";
  const double d = norm(found.on_a - found.on_b);
  if (std::abs(d * d - found.squared_m2) > kTolerance) return testing::AssertionFailure() << "not their distance";
  if (d < 1e-5) return testing::AssertionSuccess();  // too short to have a direction
  const Point n = (1.0 / d) * (found.on_a - found.on_b);
  for (int k = 0; k < 3; ++k) {
    if (dot(n, a[k] - found.on_a) < -kTolerance / d) return testing::AssertionFailure() << "a corner of A is nearer";
    if (dot(n, b[k] - found.on_b) > kTolerance / d) return testing::AssertionFailure() << "a corner of B is nearer";
  }
  return testing::AssertionSuccess();
}

TEST(TriangleDistance, RandomTrianglesAreCertified) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> at(-1.0, 1.0);
  int apart = 0;
  int crossing = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Corners a;
    Corners b;
    const double offset = trial % 3 == 0 ? 0.0 : 1.0;
    for (Point& p : a) p = {at(random), at(random), at(random)};
    for (Point& p : b) p = {at(random) + offset, at(random), at(random)};
    const Nearest found = nearest_of_triangles(a, b);
    ASSERT_TRUE(is_certified(a, b, found)) << "trial " << trial;
    (found.squared_m2 > 0.0 ? apart : crossing) += 1;
  }
  EXPECT_GT(apart, 5000);
  EXPECT_GT(crossing, 500);
}

// Corners on a 3 x 3 x 3 lattice: shared corners and edges, parallel edges, triangles in one plane, and triangles that
// are segments or points, all exactly representable.
TEST(TriangleDistance, SpecialPositionsAreCertified) {
  std::mt19937_64 random(2);
  const auto coordinate = [&] { return static_cast<double>(random() % 3); };
  for (int trial = 0; trial < 20000; ++trial) {
    Corners a;
    Corners b;
    for (Point& p : a) p = {coordinate(), coordinate(), coordinate()};
    for (Point& p : b) p = {coordinate(), coordinate() + static_cast<double>(trial % 3), coordinate()};
    ASSERT_TRUE(is_certified(a, b, nearest_of_triangles(a, b))) << "trial " << trial;
  }
}

TEST(TriangleDistance, DoesNotDependOnTheOrder) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> at(-1.0, 1.0);
  for (int trial = 0; trial < 2000; ++trial) {
    Corners a;
    Corners b;
    for (Point& p : a) p = {at(random), at(random), at(random)};
    for (Point& p : b) p = {at(random), at(random), at(random)};
    const double squared = nearest_of_triangles(a, b).squared_m2;
    EXPECT_NEAR(nearest_of_triangles(b, a).squared_m2, squared, kTolerance);
    EXPECT_NEAR(nearest_of_triangles({a[1], a[2], a[0]}, {b[2], b[1], b[0]}).squared_m2, squared, kTolerance);
  }
}

TEST(TriangleDistance, KnownCases) {
  const Corners floor{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  EXPECT_DOUBLE_EQ(nearest_of_triangles(floor, {{{1, 1, 3}, {1, 2, 5}, {2, 1, 5}}}).squared_m2, 9.0);   // corner, face
  EXPECT_DOUBLE_EQ(nearest_of_triangles(floor, {{{1, 1, -1}, {1, 1, 1}, {2, 2, 1}}}).squared_m2, 0.0);  // crossing
  EXPECT_DOUBLE_EQ(nearest_of_triangles(floor, {{{-1, 1, 2}, {-1, 3, 2}, {-5, 2, 2}}}).squared_m2, 5.0);  // two edges
  EXPECT_DOUBLE_EQ(nearest_of_triangles(floor, {{{7, 0, 4}, {9, 0, 4}, {8, 1, 9}}}).squared_m2, 25.0);    // two corners
  // A small triangle in the plane of a large one, inside it: no edge passes through, a corner lies in the face.
  EXPECT_DOUBLE_EQ(nearest_of_triangles(floor, {{{1, 1, 0}, {1.5, 1, 0}, {1, 1.5, 0}}}).squared_m2, 0.0);
}

// A soup of unrelated triangles, so that no structure helps the tree.
core::Mesh soup(std::mt19937& random, int triangles, float size) {
  std::uniform_real_distribution<float> at(-1.0F, 1.0F);
  core::Mesh mesh;
  for (int k = 0; k < triangles; ++k) {
    const core::Vec3 p{at(random), at(random), at(random)};
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int corner = 0; corner < 3; ++corner)
      mesh.vertices.push_back(p + size * core::Vec3{at(random), at(random), at(random)});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TEST(TriangleTree, FindsTheLeastOverAllPairsOfTriangles) {
  std::mt19937 random(4);
  const core::Quat quarter{std::sqrt(0.5F), 0, std::sqrt(0.5F), 0};
  int apart = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const TriangleTree a(soup(random, 5 + 4 * trial, 0.1F), {});
    const TriangleTree b(soup(random, 150 - 3 * trial, 0.2F), trial % 2 == 0 ? core::Quat{} : quarter);
    const core::Vec3 xa{0.1F * static_cast<float>(trial), 1.0F, -7.0F};
    const core::Vec3 xb{xa.x + 0.08F * static_cast<float>(trial), 1.5F, -7.0F};
    double least = nearest_of_triangles(corners_of(a, 0, xa), corners_of(b, 0, xb)).squared_m2;
    for (std::uint32_t i = 0; i < a.triangles().size(); ++i)
      for (std::uint32_t j = 0; j < b.triangles().size(); ++j)
        least = std::min(least, nearest_of_triangles(corners_of(a, i, xa), corners_of(b, j, xb)).squared_m2);
    const Nearest found = nearest_of_trees(a, xa, b, xb);
    EXPECT_EQ(found.squared_m2, least) << "trial " << trial;
    EXPECT_EQ(nearest_by_brute_force(a, xa, b, xb).squared_m2, least) << "trial " << trial;
    EXPECT_NEAR(norm(found.on_a - found.on_b), std::sqrt(least), kTolerance);
    apart += least > 0.0 ? 1 : 0;
  }
  EXPECT_GT(apart, 10);
  EXPECT_LT(apart, 40);
}

TEST(TriangleTree, NearestVerticesOfKnownPoints) {
  core::Mesh a;
  a.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  a.triangles = {{0, 1, 2}};
  core::Mesh b;
  // Eleven vertices, so that the last ones are beyond a full row of lanes; the nearest is the last.
  for (int k = 0; k < 10; ++k) b.vertices.push_back({20.0F + static_cast<float>(k), 0, 0});
  b.vertices.push_back({4, 4, 0});
  b.triangles = {{0, 1, 10}};
  const Nearest found = nearest_vertices(TriangleTree(a, {}), {0, 0, 5}, TriangleTree(b, {}), {0, 0, 5});
  EXPECT_DOUBLE_EQ(found.squared_m2, 25.0);  // (1, 0) or (0, 1) to (4, 4)
  EXPECT_DOUBLE_EQ(found.on_b.x, 4.0);
  EXPECT_DOUBLE_EQ(found.on_a.z, 5.0);
}

// METHOD section 3: the surfaces are never farther apart than the vertices, nor nearer than that less both covering
// radii.
TEST(TriangleTree, VerticesBoundSurfaces) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 10; ++trial) {
    const core::Mesh a = soup(random, 40, 0.3F);
    const core::Mesh b = soup(random, 40, 0.3F);
    const TriangleTree tree_a(a, {});
    const TriangleTree tree_b(b, {});
    const core::Vec3 x{3.0F, 0.2F * static_cast<float>(trial), 0.0F};
    const double d = std::sqrt(nearest_of_trees(tree_a, {}, tree_b, x).squared_m2);
    const double d_vv = std::sqrt(nearest_vertices(tree_a, {}, tree_b, x).squared_m2);
    EXPECT_LE(d, d_vv);
    EXPECT_LE(d_vv, d + core::covering_radius_m(a) + core::covering_radius_m(b) + 1e-6);
  }
}

}  // namespace
}  // namespace broadside::exact

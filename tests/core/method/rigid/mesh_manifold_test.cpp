// Meshes: a convex one has the distance that the exact arbiter gives for its solid; floors, notches and planes have
// contacts that can be worked out by hand.
#include "core/method/rigid/mesh_manifold.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "datasets/shapes/sphere_mesh.hpp"
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
    // Twice that of a polytope: once for the axis between a triangle and the body, once for the places of its sides.
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
    // Corners are 0.5 m from the middle. Of points that are equally deep rounding chooses the deepest one, which may
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

// For bodies that approach fast, triangles are looked at within a large reach. Most pairs are then farther apart than
// the points that are kept, and are passed over. Trying all pairs gives the same patches, bit for bit.
TEST(Meshes, FarTrianglesArePassedOverWithoutATrace) {
  Draw draw(5);
  int full = 0;
  for (int trial = 0; trial < 12; ++trial) {
    MeshBody a(datasets::lumpy_mesh(320, 1).value());
    MeshBody b(datasets::lumpy_mesh(320, 2).value());
    a.pose.q = draw.turn();
    b.pose = {draw.between(2.6F, 3.2F) * normalized(draw.in_cube(1.0F)), draw.turn()};
    const PlacedShape at_a = placed_shape(a.shape, a.pose, a.pose.x);
    const PlacedShape at_b = placed_shape(b.shape, b.pose, a.pose.x);
    const float rounding_m = contact_rounding_m(at_a, at_b);
    constexpr float kReach = 0.6F;
    mesh_detail::Touches touches;
    for (std::uint32_t i = 0; i < a.shape.mesh.triangle_count; ++i)
      for (std::uint32_t j = 0; j < b.shape.mesh.triangle_count; ++j) {
        const TrianglePolytope of_a = mesh_detail::triangle_polytope(at_a, i);
        const TrianglePolytope of_b = mesh_detail::triangle_polytope(at_b, j);
        Manifold m;
        polytope_manifold(of_a, of_b, separating_axis(of_a, of_b, rounding_m, kReach), 0.0F, 0.0F, rounding_m, kReach,
                          m);
        if (m.count == 0 || !mesh_detail::looks(at_b, j, of_b.normal, m.normal) ||
            !mesh_detail::looks(at_a, i, of_a.normal, -m.normal))
          continue;
        for (int k = 0; k < m.count; ++k)
          m.points[k].feature = mesh_detail::key_in_mesh(mesh_detail::key_in_mesh(m.points[k].feature, i), j);
        mesh_detail::take_all<OneLane>(m, rounding_m, touches);
      }
    Manifold all[kPatchesOfPair];
    const int patches = mesh_detail::patches_of<OneLane>(touches, rounding_m, kReach, all);
    Manifold found[kPatchesOfPair];
    ASSERT_EQ(make_manifolds(a.shape, a.pose, b.shape, b.pose, kReach, found), patches) << "trial " << trial;
    for (int k = 0; k < patches; ++k) {
      EXPECT_EQ(found[k].normal, all[k].normal) << "trial " << trial;
      ASSERT_EQ(found[k].count, all[k].count) << "trial " << trial;
      for (int p = 0; p < found[k].count; ++p) {
        EXPECT_EQ(found[k].points[p].gap_m, all[k].points[p].gap_m) << "trial " << trial;
        EXPECT_EQ(found[k].points[p].point, all[k].points[p].point) << "trial " << trial;
      }
    }
    full += touches.count == kMeshPoints ? 1 : 0;
  }
  EXPECT_GT(full, 0) << "no trial had more points than are kept";
}

// Where nodes are passed over because of the directions they face, no two of their triangles face each other; and some
// nodes are passed over.
TEST(Meshes, NodesLookWhereverATriangleDoes) {
  Draw draw(6);
  MeshBody a(datasets::lumpy_mesh(320, 1).value());
  MeshBody b(datasets::lumpy_mesh(320, 2).value());
  int passed_over = 0;
  for (int trial = 0; trial < 4; ++trial) {
    const PlacedShape at_a = placed_shape(a.shape, {{}, draw.turn()}, {});
    const PlacedShape at_b = placed_shape(b.shape, {{}, draw.turn()}, {});
    for (const TriangleNode& of_a : a.tables.nodes)
      for (const TriangleNode& of_b : b.tables.nodes) {
        if (of_a.count == 0 || of_b.count == 0 || mesh_detail::may_look_at_each_other(at_a, of_a, at_b, of_b)) continue;
        ++passed_over;
        for (std::uint32_t i = of_a.first; i < of_a.first + of_a.count; ++i)
          for (std::uint32_t j = of_b.first; j < of_b.first + of_b.count; ++j)
            EXPECT_FALSE(mesh_detail::may_look_at_each_other(
                mesh_detail::least_looking(a.tables.least_facing[i]), turned(at_a.axes, a.tables.normals[i]),
                mesh_detail::least_looking(b.tables.least_facing[j]), turned(at_b.axes, b.tables.normals[j])));
      }
  }
  EXPECT_GT(passed_over, 1000);
}

// Checked by the distance to every triangle and by the solid angle that all of them fill.
TEST(MeshInside, IsWhereTheSurfaceSurrounds) {
  Draw draw(8);
  const MeshBody body(datasets::lumpy_mesh(320, 1).value(), true);
  int inside = 0;
  for (int trial = 0; trial < 400; ++trial) {
    // Some points lie on lines through vertices, where a ray meets corners and edges.
    Vec3 p = draw.in_cube(1.3F);
    if (trial % 3 == 0) {
      const Vec3 v =
          body.mesh.vertices[static_cast<std::size_t>(draw.below(static_cast<int>(body.mesh.vertices.size())))];
      p = {draw.between(-1.3F, 1.3F), v.y, v.z};
    }
    double angle = 0.0;
    double nearest = 1e30;
    for (std::uint32_t t = 0; t < body.shape.mesh.triangle_count; ++t) {
      exact::Point c[3];
      for (std::uint32_t k = 0; k < 3; ++k)
        c[k] = exact::to_point(body.shape.mesh.vertices[body.shape.mesh.triangles[3 * t + k]]) - exact::to_point(p);
      const auto norm = [](exact::Point q) { return std::sqrt(dot(q, q)); };
      const double la = norm(c[0]), lb = norm(c[1]), lc = norm(c[2]);
      angle += 2.0 * std::atan2(dot(c[0], cross(c[1], c[2])),
                                la * lb * lc + dot(c[0], c[1]) * lc + dot(c[1], c[2]) * la + dot(c[2], c[0]) * lb);
      // The nearest of many points of the triangle, which is no nearer than the true distance.
      for (int u = 0; u <= 12; ++u)
        for (int w = 0; u + w <= 12; ++w) {
          const double s = u / 12.0, r = w / 12.0;
          nearest = std::min(nearest, norm((1.0 - s - r) * c[0] + s * c[1] + r * c[2]));
        }
    }
    if (nearest < 1e-4) continue;
    const bool is_in = angle > 2.0 * 3.14159265358979;
    EXPECT_EQ(is_inside(body.shape.mesh, p), is_in) << trial;
    inside += is_in ? 1 : 0;
    const NearestOfMesh found = nearest_of_mesh(body.shape.mesh, p, 10.0F);
    const double distance = std::sqrt(static_cast<double>(found.squared_m2));
    EXPECT_LE(distance, nearest + 1e-5) << trial;
    EXPECT_GE(distance, nearest - 0.02) << trial;
    EXPECT_NEAR(length(found.point - p), distance, 1e-5);
  }
  EXPECT_GT(inside, 50);
  EXPECT_LT(inside, 350);
}

// Two balls of triangles, deeper in each other than triangles are large. Before, no point was found in any of these
// poses.
TEST(Meshes, DeepInEachOtherHaveThePointsOfTheirVertices) {
  Draw draw(9);
  MeshBody a(datasets::sphere_mesh(1.0, 8).value(), true);
  MeshBody b(datasets::sphere_mesh(1.0, 8).value(), true);
  const float radius = a.shape.size_m;
  for (int trial = 0; trial < 20; ++trial) {
    a.pose.q = draw.turn();
    b.pose.q = draw.turn();
    const Vec3 direction = normalized(draw.in_cube(1.0F));
    const float depth = (trial % 2 == 0 ? 0.03F : 0.3F) * radius;
    b.pose.x = (2.0F * radius - depth) * direction;
    Manifold m[kPatchesOfPair];
    const int count = make_manifolds(a.shape, a.pose, b.shape, b.pose, 0.01F, m);
    ASSERT_GE(count, 1) << "trial " << trial;
    // Facets are flatter than the ball by 0.3 % of the radius, and a vertex is up to 6 % beside the axis.
    EXPECT_LE(-deepest(m, count), depth) << trial;
    EXPECT_GE(-deepest(m, count), depth - 0.012F * radius) << trial;
    EXPECT_LT(dot(m[0].normal, direction), -0.95F) << trial;
    for (int k = 0; k < m[0].count; ++k) {
      const ManifoldPoint& p = m[0].points[k];
      if (p.gap_m > deepest(m, 1)) continue;  // the normal is that of the deepest
      const Vec3 half = (0.5F * p.gap_m) * m[0].normal;
      EXPECT_NEAR(length(p.point + half), radius, 0.015F * radius) << "off A, trial " << trial;
      EXPECT_NEAR(length((p.point - half) - b.pose.x), radius, 0.015F * radius) << "off B, trial " << trial;
    }
  }
}

}  // namespace
}  // namespace broadside::core

// Manifolds against the exact arbiter: gaps, normals, points on both surfaces, for random and for special positions.
#include "core/method/rigid/make_manifolds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string_view>
#include <vector>

#include "core/exact/convex_hull.hpp"
#include "tests/core/method/rigid/manifold_cases.hpp"

namespace broadside::core {
namespace {

using Make = std::function<Subject(Draw&)>;

Subject any_box(Draw& draw) {
  return box({draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F)});
}
Subject any_sphere(Draw& draw) {
  return sphere(draw.between(0.2F, 1.0F));
}
Subject any_capsule(Draw& draw) {
  return capsule(draw.between(0.1F, 0.5F), draw.between(0.1F, 1.0F), draw.below(3));
}

Mesh scaled(Mesh mesh, float by) {
  for (Vec3& v : mesh.vertices) v = by * v;
  return mesh;
}

// An octahedron, a prism with quadrangles, or the hull of random points.
Mesh any_convex_mesh(Draw& draw) {
  Mesh mesh;
  const int which = draw.below(3);
  if (which == 0) {
    mesh.vertices = {{0.7F, 0, 0}, {-0.7F, 0, 0}, {0, 0.7F, 0}, {0, -0.7F, 0}, {0, 0, 0.7F}, {0, 0, -0.7F}};
  } else if (which == 1) {
    for (const float z : {-0.5F, 0.5F})
      for (const Vec3 v :
           {Vec3{0.5F, 0, 0}, Vec3{0, 0.5F, 0}, Vec3{-0.5F, 0, 0}, Vec3{-0.3F, -0.5F, 0}, Vec3{0.3F, -0.5F, 0}})
        mesh.vertices.push_back({v.x, v.y, z});
  } else {
    for (int k = 0; k < 14; ++k) mesh.vertices.push_back(0.8F * normalized(draw.in_cube(1.0F)));
  }
  return *exact::convex_hull(mesh.vertices);
}
Subject any_hull(Draw& draw) {
  return hull(scaled(any_convex_mesh(draw), draw.between(0.5F, 1.5F)));
}

struct Family {
  const char* name;
  Make a;
  Make b;

  // The arbiter tries every pair of edges of two hulls, so cases of hulls get a fifth of the trials.
  [[nodiscard]] int trials(int most) const { return std::string_view(name).ends_with("hull") ? most / 5 : most; }
};

std::vector<Family> families() {
  return {{"sphere-sphere", any_sphere, any_sphere},
          {"sphere-box", any_sphere, any_box},
          {"box-sphere", any_box, any_sphere},
          {"sphere-capsule", any_sphere, any_capsule},
          {"capsule-capsule", any_capsule, any_capsule},
          {"capsule-box", any_capsule, any_box},
          {"box-box", any_box, any_box},
          {"sphere-hull", any_sphere, any_hull},
          {"capsule-hull", any_capsule, any_hull},
          {"box-hull", any_box, any_hull},
          {"hull-hull", any_hull, any_hull}};
}

// B is put so that the two are near: along a random direction, by bisection on the exact distance.
void bring_near(Subject& a, Subject& b, Vec3 direction, double distance) {
  double low = 0.0;
  double high = 2.0 * (a.shape.size_m + b.shape.size_m) + distance;
  for (int k = 0; k < 30; ++k) {
    const double middle = 0.5 * (low + high);
    b.pose.x = a.pose.x + static_cast<float>(middle) * direction;
    const double found = exact::signed_distance(a.placed(), b.placed()).distance_m;
    (found < distance ? low : high) = middle;
  }
}

TEST(Manifolds, OfRandomPairsAgreeWithTheExactDistance) {
  for (const Family& family : families()) {
    Draw draw(1);
    int apart = 0;
    int deep = 0;
    for (int trial = 0; trial < family.trials(1500); ++trial) {
      Subject a = family.a(draw);
      Subject b = family.b(draw);
      a.pose = {draw.in_cube(1.0F), draw.turn()};
      b.pose = {draw.in_cube(1.0F), draw.turn()};
      const Vec3 direction = normalized(draw.in_cube(1.0F));
      const double distances[] = {-0.2, -0.01, -1e-4, 0.0, 1e-6, 1e-4, 0.01, 0.05};
      bring_near(a, b, direction, distances[draw.below(8)]);
      ASSERT_TRUE(is_right(a, b, 0.1F)) << family.name << ", trial " << trial << "\n"
                                        << text_of(a) << "\n"
                                        << text_of(b);
      const double distance = exact::signed_distance(a.placed(), b.placed()).distance_m;
      apart += distance > 0.005 ? 1 : 0;
      deep += distance < -0.005 ? 1 : 0;
    }
    EXPECT_GT(apart, family.trials(200)) << family.name;
    EXPECT_GT(deep, family.trials(200)) << family.name;
  }
}

// Hulls with so many pairs of edges that a bound on the distance decides which pairs are looked at: round hulls and
// flat ones, within a reach that leaves none of them out.
TEST(Manifolds, OfHullsWithManyEdgesAgreeWithTheExactDistance) {
  Draw draw(7);
  const auto many_edges = [&draw] {
    const Vec3 sides{draw.between(0.1F, 1.0F), draw.between(0.1F, 1.0F), 1.0F};
    std::vector<Vec3> points;
    for (int k = 0; k < 32; ++k) {
      const Vec3 p = normalized(draw.in_cube(1.0F));
      points.push_back({sides.x * p.x, sides.y * p.y, sides.z * p.z});
    }
    return hull(*exact::convex_hull(points));
  };
  for (int trial = 0; trial < 21; ++trial) {
    Subject a = many_edges();
    Subject b = many_edges();
    ASSERT_GT(a.shape.hull.edge_count * b.shape.hull.edge_count, 4096U);
    a.pose = {draw.in_cube(1.0F), draw.turn()};
    b.pose = {draw.in_cube(1.0F), draw.turn()};
    const double distances[] = {-0.01, 0.0, 1e-6, 1e-4, 0.01, 0.05, 0.3};
    bring_near(a, b, normalized(draw.in_cube(1.0F)), distances[trial % 7]);
    ASSERT_TRUE(is_right(a, b, 2.0F)) << "trial " << trial << "\n" << text_of(a) << "\n" << text_of(b);
  }
}

// Parallel faces and edges, corners on faces and on corners: sizes and places on a lattice, axes to axes.
TEST(Manifolds, OfSpecialPositionsAgreeWithTheExactDistance) {
  for (const Family& family : families()) {
    Draw draw(2);
    for (int trial = 0; trial < family.trials(3000); ++trial) {
      Subject a = family.a(draw);
      Subject b = family.b(draw);
      const auto on_lattice = [&](Subject& s) {
        const auto size = [&] { return 0.25F * static_cast<float>(1 + draw.below(4)); };
        if (s.shape.kind == ContactKind::kBox) s = box({size(), size(), size()});
        if (s.shape.kind == ContactKind::kSphere) s = sphere(size());
        if (s.shape.kind == ContactKind::kHull) {
          Mesh octahedron;
          for (const float r : {-size(), size()})
            for (int axis = 0; axis < 3; ++axis) octahedron.vertices.push_back(axis_vector(axis, r));
          s = hull(*exact::convex_hull(octahedron.vertices));
        }
        if (s.shape.kind == ContactKind::kCapsule) s = capsule(size(), size(), draw.below(3));
        const auto at = [&] { return 0.25F * static_cast<float>(draw.below(9) - 4); };
        s.pose = {{at(), at(), at()}, draw.quarter_turns()};
      };
      on_lattice(a);
      on_lattice(b);
      ASSERT_TRUE(is_right(a, b, 0.3F)) << family.name << ", trial " << trial << "\n"
                                        << text_of(a) << "\n"
                                        << text_of(b);
    }
  }
}

TEST(Manifolds, SwappedBodiesHaveTheSameGapsAndTheOppositeNormal) {
  for (const Family& family : families()) {
    Draw draw(3);
    for (int trial = 0; trial < family.trials(500); ++trial) {
      Subject a = family.a(draw);
      Subject b = family.b(draw);
      a.pose = {draw.in_cube(1.0F), draw.turn()};
      b.pose = {{}, draw.turn()};
      bring_near(a, b, normalized(draw.in_cube(1.0F)), draw.between(-0.05F, 0.02F));
      Manifold there[kPatchesOfPair];
      Manifold back[kPatchesOfPair];
      const int found = make_manifolds(a.shape, a.pose, b.shape, b.pose, 0.05F, there);
      ASSERT_EQ(found, make_manifolds(b.shape, b.pose, a.shape, a.pose, 0.05F, back));
      if (found == 0) continue;
      ASSERT_TRUE(is_right(b, a, 0.05F)) << family.name << ", trial " << trial;
      double deepest = 1.0;
      double deepest_back = 1.0;
      for (int k = 0; k < there[0].count; ++k) deepest = std::min<double>(deepest, there[0].points[k].gap_m);
      for (int k = 0; k < back[0].count; ++k) deepest_back = std::min<double>(deepest_back, back[0].points[k].gap_m);
      EXPECT_NEAR(deepest, deepest_back, 6.0 * rounding_of(a, b));
    }
  }
}

// Bodies of 1 : 1000, of a millimeter and of a kilometer, and far from the origin: the bound scales with the lengths
// that go into a gap, not with the distance from the origin.
TEST(Manifolds, HoldForTinyAndHugeBodiesFarFromTheOrigin) {
  for (const Family& family : families()) {
    Draw draw(4);
    for (int trial = 0; trial < family.trials(300); ++trial) {
      Subject a = family.a(draw);
      Subject b = family.b(draw);
      const auto scaled = [&](Subject s, float by) {
        if (s.shape.kind == ContactKind::kBox) return box(by * s.shape.half);
        if (s.shape.kind == ContactKind::kHull) {
          std::vector<Vec3> points(s.tables->vertices);
          for (Vec3& v : points) v = by * v;
          return hull(*exact::convex_hull(points));
        }
        return ball_on_segment(s.shape.kind, by * s.shape.radius_m, by * s.shape.half_length_m, s.shape.axis);
      };
      const float sizes[] = {1e-3F, 1.0F, 1e3F};
      const float size = sizes[draw.below(3)];
      a = scaled(a, size);
      b = scaled(b, draw.below(2) == 0 ? size : 1e-3F * size);
      a.pose = {size * draw.in_cube(1.0F), draw.turn()};
      if (draw.below(2) == 0) a.pose.x = a.pose.x + Vec3{1000.0F, -2000.0F, 500.0F};
      b.pose.q = draw.turn();
      bring_near(a, b, normalized(draw.in_cube(1.0F)), b.shape.size_m * draw.between(-0.1F, 0.02F));
      ASSERT_TRUE(is_right(a, b, 0.05F * b.shape.size_m)) << family.name << ", trial " << trial << "\n"
                                                          << text_of(a) << "\n"
                                                          << text_of(b);
    }
  }
}

}  // namespace
}  // namespace broadside::core

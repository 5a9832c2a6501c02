// Expected values: supports of many points of each surface, in double.
#include "core/method/rigid/turned_box.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "core/exact/convex_hull.hpp"
#include "core/method/rigid/motion_reach.hpp"
#include "core/scene/body_octree.hpp"
#include "core/scene/hull_faces.hpp"

namespace broadside::core {
namespace {

struct TurnedPoint {
  double x, y, z;
};

// By the rotation of q, of any length, in double.
TurnedPoint turned_by(Quat q, TurnedPoint p) {
  const double n = std::sqrt(double(q.w) * q.w + double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z);
  const double w = q.w / n;
  const double x = q.x / n;
  const double y = q.y / n;
  const double z = q.z / n;
  return {(1 - 2 * (y * y + z * z)) * p.x + 2 * (x * y - w * z) * p.y + 2 * (x * z + w * y) * p.z,
          2 * (x * y + w * z) * p.x + (1 - 2 * (x * x + z * z)) * p.y + 2 * (y * z - w * x) * p.z,
          2 * (x * z - w * y) * p.x + 2 * (y * z + w * x) * p.y + (1 - 2 * (x * x + y * y)) * p.z};
}

Quat random_turn(std::mt19937& random) {
  std::normal_distribution<float> normal;
  const Quat q{normal(random), normal(random), normal(random), normal(random)};
  return (1.0F / std::sqrt(dot(q, q))) * q;
}

VertexTreeView view_of(const BodyOctree& tree) {
  return {tree.boxes.data() + kLevelOffset[1], tree.boxes.data() + kLevelOffset[2], tree.leaf_begin.data(),
          tree.sorted_vertices.data()};
}

// The extent along a unit axis of the world, from the shape's center, by its definition: the farthest of its points.
// A round part is a ball or a rim, whose farthest point is where its normal is the axis.
double exact_reach(const ContactShape& s, const std::vector<Vec3>& vertices, Quat q, int axis, double sign) {
  TurnedPoint back =
      turned_by({q.w, -q.x, -q.y, -q.z}, {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0});
  const double d[3] = {back.x, back.y, back.z};
  if (s.kind == ContactKind::kBox)
    return std::abs(d[0]) * s.half.x + std::abs(d[1]) * s.half.y + std::abs(d[2]) * s.half.z;
  if (s.kind == ContactKind::kSphere) return s.radius_m;
  if (s.kind == ContactKind::kCapsule) return s.radius_m + s.half_length_m * std::abs(d[s.axis]);
  if (s.kind == ContactKind::kCylinder)
    return s.half_length_m * std::abs(d[s.axis]) + s.radius_m * std::hypot(d[(s.axis + 1) % 3], d[(s.axis + 2) % 3]);
  double best = -std::numeric_limits<double>::infinity();
  for (const Vec3 v : vertices) best = std::max(best, d[0] * v.x + d[1] * v.y + d[2] * v.z);
  return best;
}

struct Case {
  ContactShape shape;
  std::vector<Vec3> vertices;
  HullTables tables;  // of a hull: what the shape's view points into
};

void add_hull(Case& c) {
  const auto hull = exact::convex_hull(c.vertices);
  ASSERT_TRUE(hull.has_value());
  c.tables = hull_tables(*hull);
  HullView& view = c.shape.hull;
  view.vertices = c.tables.vertices.data();
  view.ways = c.tables.ways.data();
  view.guide = c.tables.guide.data();
  view.vertex_count = static_cast<std::uint32_t>(c.tables.vertices.size());
}

std::vector<Case> cases(std::mt19937& random) {
  std::uniform_real_distribution<float> side(0.01F, 2.0F);
  std::vector<Case> all;
  for (const ContactKind kind : {ContactKind::kBox, ContactKind::kSphere, ContactKind::kCapsule, ContactKind::kCylinder,
                                 ContactKind::kHull, ContactKind::kMesh}) {
    for (int axis = 0; axis < 3; ++axis) {
      Case c;
      c.shape.kind = kind;
      c.shape.axis = axis;
      c.shape.center = {side(random) - 1.0F, side(random) - 1.0F, side(random) - 1.0F};
      c.shape.half = {side(random), side(random), side(random)};
      c.shape.radius_m = side(random);
      c.shape.half_length_m = side(random);
      for (int k = 0; k < 200; ++k)
        c.vertices.push_back({side(random) - 1.0F, 3.0F * side(random) - 3.0F, 0.1F * side(random)});
      c.shape.size_m = 8.0F;
      if (kind == ContactKind::kHull) add_hull(c);
      all.push_back(std::move(c));
    }
  }
  return all;
}

TEST(TurnedBox, ContainsTheShapeAndIsTight) {
  std::mt19937 random(20261124);
  std::uniform_real_distribution<float> place(-50.0F, 50.0F);
  for (const Case& c : cases(random)) {
    const BodyOctree tree = build_body_octree(c.vertices);
    for (int k = 0; k < 200; ++k) {
      Quat q = random_turn(random);
      if (k == 0) q = {};
      if (k == 1) q = {std::sqrt(0.5F), std::sqrt(0.5F), 0.0F, 0.0F};
      const Vec3 x{place(random), place(random), place(random)};
      const Box box = turned_box(c.shape, view_of(tree), x, q);
      const TurnedPoint center = turned_by(q, {c.shape.center.x, c.shape.center.y, c.shape.center.z});
      const double from[3] = {center.x, center.y, center.z};
      for (int axis = 0; axis < 3; ++axis) {
        const double high = x[axis] + from[axis] + exact_reach(c.shape, c.vertices, q, axis, 1.0);
        const double low = x[axis] + from[axis] - exact_reach(c.shape, c.vertices, q, axis, -1.0);
        ASSERT_GE(box.max[axis], high);
        ASSERT_LE(box.min[axis], low);
        // At most twice the padding: once for the padding itself, and once for the rounding that it covers.
        const double waste =
            2.0 * 0x1p-24 *
            (kBoxRoundingsOfReach * (8.0 + std::sqrt(3.0)) + kBoxRoundingsOfPosition * (std::abs(x[axis]) + 10.0));
        ASSERT_LE(box.max[axis] - high, waste);
        ASSERT_LE(low - box.min[axis], waste);
      }
    }
  }
}

// A prism whose long edges have corners between their ends. When it is turned about its axis, no such edge leads
// downhill along an axis of the world: a search that reaches a corner in the middle of an edge would end there.
TEST(TurnedBox, ContainsAPrismWithCornersAlongItsEdges) {
  constexpr int kSides = 24;
  constexpr int kRings = 5;
  Case c;
  for (int side = 0; side < kSides; ++side)
    for (int ring = 0; ring < kRings; ++ring) {
      const float angle = 6.2831853F * static_cast<float>(side) / kSides;
      c.vertices.push_back({0.5F * std::cos(angle), 0.5F * std::sin(angle), 0.25F * static_cast<float>(ring)});
    }
  c.shape.kind = ContactKind::kHull;
  c.shape.size_m = 1.2F;
  add_hull(c);
  const double waste = 4.0 * 0x1p-24 * kBoxRoundingsOfReach * 1.2;
  for (int k = 0; k < 2000; ++k) {
    const float half = 0.5F * 0.00314F * static_cast<float>(k);
    // About its own axis, and about that axis and one across it.
    for (const float across : {0.0F, 1e-7F, 0.1F}) {
      Quat q{std::cos(half), across, 0.0F, std::sin(half)};
      q = (1.0F / std::sqrt(dot(q, q))) * q;
      const Box box = turned_box(c.shape, {}, {}, q);
      for (int axis = 0; axis < 3; ++axis) {
        const double high = exact_reach(c.shape, c.vertices, q, axis, 1.0);
        const double low = -exact_reach(c.shape, c.vertices, q, axis, -1.0);
        ASSERT_GE(box.max[axis], high) << k << " " << across;
        ASSERT_LE(box.min[axis], low) << k << " " << across;
        ASSERT_LE(box.max[axis] - high, waste);
        ASSERT_LE(low - box.min[axis], waste);
      }
    }
  }
}

TEST(TurnedBox, TheVertexTreeFindsWhatALoopOverAllVerticesFinds) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  for (const int count : {1, 2, 9, 1000}) {
    std::vector<Vec3> vertices;
    for (int k = 0; k < count; ++k) vertices.push_back({normal(random), normal(random), 0.2F * normal(random)});
    const BodyOctree tree = build_body_octree(vertices);
    for (int k = 0; k < 300; ++k) {
      const Vec3 d = rotate(random_turn(random), {1.0F, 0.0F, 0.0F});
      float most = -std::numeric_limits<float>::infinity();
      for (const Vec3 v : vertices) most = std::max(most, dot(d, v));
      ASSERT_EQ(vertex_support(view_of(tree), d), most);
    }
  }
}

TEST(MotionReach, IsTheWayOfTheCenterAndOfTheFarthestPoint) {
  RigidMass mass;
  mass.inverse_mass = 0.5F;
  mass.inverse_inertia.xx = mass.inverse_inertia.yy = mass.inverse_inertia.zz = 2.0F;
  RigidState s;
  s.v = {3.0F, 0.0F, 4.0F};
  s.angular_momentum = {0.0F, 0.5F, 0.0F};  // 1 rad/s
  const Vec3 g{0.0F, -10.0F, 0.0F};
  // In 0.1 s: 5 m/s and the 1 m/s that gravity adds, and a turn of 0.1 rad at an arm of 2 m.
  EXPECT_NEAR(free_motion(s, mass, {2.0F, 0.5F}, g, {}, 0.1F).reach_m(), 0.1F * (5.0F + 1.0F) + 0.2F, 1e-6F);
  // A ball about its center of mass adds nothing by turning, however fast.
  s.angular_momentum = {0.0F, 500.0F, 0.0F};
  EXPECT_NEAR(free_motion(s, mass, {2.0F, 2.0F}, g, {}, 0.1F).reach_m(), 0.6F, 1e-6F);
  EXPECT_NEAR(free_motion(s, mass, {2.0F, 0.5F}, g, {}, 0.1F).reach_m(), 0.6F + 1.5F, 1e-6F);
  EXPECT_EQ(free_motion(s, RigidMass{}, {2.0F, 0.5F}, g, {}, 0.1F).reach_m(), 0.0F);
}

// A wrench of 2 N upward on 2 kg is 1 m/s^2, so the body falls with 9 m/s^2. It falls 0.09 m in the first of two steps
// of 0.1 s, and 0.18 m more in the second, which starts with the speed of the first. To every other side the box is
// larger by 0.09 m.
TEST(MotionReach, ASweptBoxGoesFromTheStartToWhereItDriftsAndFalls) {
  RigidMass mass;
  mass.inverse_mass = 0.5F;
  RigidState s;
  s.v = {2.0F, 0.5F, 0.0F};
  const FreeMotion m = free_motion(s, mass, {1.0F, 1.0F}, {0.0F, -10.0F, 0.0F}, {{0.0F, 2.0F, 0.0F}, {}, {}, {}}, 0.1F);
  const Box box = swept_box({{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}}, m, 2);
  const float pad = 2.0F * 0x1p-22F * 2.0F;
  EXPECT_NEAR(box.min.x, -1.09F, pad);
  EXPECT_NEAR(box.max.x, 1.0F + 2.0F * 0.2F, pad);
  EXPECT_NEAR(box.min.y, -1.0F + 2.0F * 0.05F - 0.09F - 0.18F, pad);
  EXPECT_NEAR(box.max.y, 1.09F, pad);
  EXPECT_NEAR(box.min.z, -1.09F, pad);
  EXPECT_NEAR(box.max.z, 1.09F, pad);
}

TEST(MotionReach, AFastBodyIsLookedForFurtherAhead) {
  FreeMotion m;
  m.drift = {0.3F, 0.4F, 0.0F};
  EXPECT_EQ(steps_ahead(m, 0.51F), 2);
  EXPECT_EQ(steps_ahead(m, 0.49F), 4);
  EXPECT_NEAR(swept_box({{-1.0F, -1.0F, -1.0F}, {1.0F, 1.0F, 1.0F}}, m, 4).max.y, 1.0F + 4 * 0.4F, 1e-6F);
}

}  // namespace
}  // namespace broadside::core

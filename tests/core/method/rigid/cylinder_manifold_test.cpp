// Cylinders, for which the exact arbiter of convex cores has no formula: the points certify themselves. A point that
// lies on both surfaces says that the bodies are no farther apart than its gap; the plane across the normal says that
// they are no nearer. Where they overlap, no direction of a fine search may separate them by a shorter way.
#include "core/method/rigid/cylinder_manifold.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/core/method/rigid/cylinder_cases.hpp"
#include "tests/core/method/rigid/mesh_cases.hpp"

namespace broadside::core {
namespace {

using exact::Point;

testing::AssertionResult is_certified(const Subject& a, const Subject& b, float reach_m) {
  const auto wrong = [] { return testing::AssertionFailure(); };
  Manifold m[kPatchesOfPair];
  const int count = make_manifolds(a.shape, a.pose, b.shape, b.pose, reach_m, m);
  // As for polytopes; and a rim is round only to within two roundings of the radius.
  const double rounding = 3.0 * rounding_of(a, b);
  const double widest = widest_gap(a, b);
  if (count == 0) {
    if (widest > reach_m - rounding) return testing::AssertionSuccess();
    return wrong() << "no points, and no direction parts them by more than " << widest << " m";
  }
  const Point n = exact::to_point(m[0].normal);
  double deepest = 1e30;
  for (int k = 0; k < m[0].count; ++k) {
    const ManifoldPoint& p = m[0].points[k];
    deepest = std::min(deepest, static_cast<double>(p.gap_m));
    const Point middle = at_world(a, p.point);
    // Points along a line or around an end share the normal of the deepest one, which is up to 8 degrees from their
    // own.
    const double allowed = 2.0 * rounding + 0.5 * 0.1411 * std::abs(p.gap_m);
    const double off_a = off(a, middle + (0.5 * p.gap_m) * n);
    const double off_b = off(b, middle - (0.5 * p.gap_m) * n);
    if (!(off_a <= allowed) || !(off_b <= allowed))
      return wrong() << "point " << k << " of " << m[0].count << ", gap " << p.gap_m << " m, is " << off_a
                     << " m off A, " << off_b << " m off B, allowed " << allowed << " m";
  }
  const double along = gap_along(a, b, n);
  if (!(std::abs(along - deepest) <= 2.0 * rounding))
    return wrong() << "gap " << deepest << " m, along the normal " << along << " m, rounding " << rounding;
  if (!(widest <= deepest + 2.0 * rounding))
    return wrong() << "gap " << deepest << " m, but a direction parts them by " << widest << " m, rounding "
                   << rounding;
  return testing::AssertionSuccess();
}

// Two that overlap along the normals of all faces, by 9.5 mm at least, and are 99 mm apart along an axis across both
// rims.
struct FarRims {
  Subject a = cylinder(0x1.91ee74p-2F, 0x1.ceb73p-3F, 1);
  Subject b = cylinder(0x1.50504ep-2F, 0x1.1f585ep-3F, 1);

  FarRims() {
    a.pose.q = {-0x1.1346b4p-1F, 0x1.6e2b76p-2F, -0x1.3f15e4p-1F, -0x1.c3cd7p-2F};
    b.pose = {{0x1.0ab43ap-2F, -0x1.d73ed6p-2F, -0x1.63deb8p-1F},
              {0x1.98e71p-1F, -0x1.132488p-1F, 0x1.24f91ep-9F, -0x1.1566bp-2F}};
  }
};
constexpr float kReaches[] = {-0.005F, 0.0F, 0.05F, 0.2F};

TEST(Cylinders, WhoseRimsAreFarApartHaveNoPoints) {
  const FarRims pair;
  EXPECT_NEAR(widest_gap(pair.a, pair.b), 0.099, 0.001);
  for (const float reach_m : kReaches) EXPECT_TRUE(is_certified(pair.a, pair.b, reach_m)) << reach_m;
}

// The hull of the even prism that stands for a cylinder, less one corner: a whole one is a drawing of that cylinder.
Subject prism_of(const Subject& s) {
  const CylinderPolytope prism = cylinder_polytope(placed_shape(s.shape, {}, {}), 0, {});
  std::vector<Vec3> corners;
  for (int k = 1; k < prism.corner_count(); ++k) corners.push_back(prism.corner(k));
  Subject out = hull(*exact::convex_hull(corners));
  out.pose = s.pose;
  return out;
}

TEST(Prisms, WhoseRimsAreFarApartHaveNoPoints) {
  const FarRims pair;
  for (const float reach_m : kReaches) {
    EXPECT_TRUE(is_right(prism_of(pair.a), prism_of(pair.b), reach_m)) << reach_m;
    Manifold out[kPatchesOfPair];
    const Subject b = prism_of(pair.b);
    const int count = make_manifolds(pair.a.shape, pair.a.pose, b.shape, b.pose, reach_m, out);
    EXPECT_EQ(count, reach_m > 0.1F ? 1 : 0) << "a cylinder and a prism, " << reach_m;
  }
}

TEST(Cylinders, OfRandomPairsAreCertified) {
  Draw draw(1);
  int apart = 0;
  int deep = 0;
  for (int trial = 0; trial < 600; ++trial) {
    Subject a = cylinder(draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F), draw.below(3));
    Subject b = other_body(draw, trial % 4);
    a.pose = {draw.in_cube(1.0F), draw.turn()};
    b.pose = {draw.in_cube(1.0F), draw.turn()};
    const Vec3 direction = normalized(draw.in_cube(1.0F));
    const float distances[] = {-0.05F, -0.01F, 0.0F, 1e-4F, 0.02F, 0.05F};
    const float wanted = distances[draw.below(6)];
    double low = 0.0;
    double high = 6.0;
    for (int k = 0; k < 12; ++k) {
      b.pose.x = a.pose.x + static_cast<float>(0.5 * (low + high)) * direction;
      (widest_gap(a, b) < wanted ? low : high) = 0.5 * (low + high);
    }
    ASSERT_TRUE(is_certified(a, b, 0.1F)) << "trial " << trial << "\n" << text_of(a) << "\n" << text_of(b);
    ASSERT_TRUE(is_certified(b, a, 0.1F)) << "trial " << trial << ", swapped\n" << text_of(b) << "\n" << text_of(a);
    apart += wanted > 0.01F ? 1 : 0;
    deep += wanted < 0.0F ? 1 : 0;
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(deep, 100);
}

// Before, 2 of these had a point up to 4 cm off a surface: where the capsule's line is above an end of the cylinder.
TEST(Cylinders, WithACapsuleDeepInThemAreCertified) {
  Draw draw(21);
  for (int trial = 0; trial < 100; ++trial) {
    Subject a = cylinder(draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F), draw.below(3));
    Subject b = other_body(draw, 1);
    a.pose = {draw.in_cube(1.0F), draw.turn()};
    b.pose.q = draw.turn();
    const Vec3 direction = normalized(draw.in_cube(1.0F));
    double low = 0.0;
    double high = 6.0;
    for (int k = 0; k < 8; ++k) {
      b.pose.x = a.pose.x + static_cast<float>(0.5 * (low + high)) * direction;
      (widest_gap(a, b) < -0.2 ? low : high) = 0.5 * (low + high);
    }
    EXPECT_TRUE(is_certified(a, b, 0.1F)) << "trial " << trial << "\n" << text_of(a) << "\n" << text_of(b);
  }
}

// q, turned by the small angles u about x and v about y.
Quat tilted(Quat q, float u, float v) {
  u *= 0.5F;
  v *= 0.5F;
  const Quat t{q.w - u * q.x - v * q.y, q.x + u * q.w + v * q.z, q.y + v * q.w - u * q.z, q.z + u * q.y - v * q.x};
  const float size = std::sqrt(t.w * t.w + t.x * t.x + t.y * t.y + t.z * t.z);
  return {t.w / size, t.x / size, t.y / size, t.z / size};
}

// Two cylinders end to end, 11 cm apart, whose normal is the axis of one of them to within rounding. Before, they had a
// point 11 cm deep, because the deepest point of that one was sought along what rounding had left.
TEST(Cylinders, EndToEndAreCertified) {
  Subject a = cylinder(0.25F, 0.5F, 2);
  Subject b = a;
  a.pose = {{-1.39149904F, 1.64797962F, 1.25724995F}, {}};
  b.pose = {{-1.3187325F, 1.67841899F, 0.124134161F}, {0.986145914F, -0.000168300059F, -0.0476595946F, -0.158885822F}};
  EXPECT_TRUE(is_certified(a, b, 0.15F));
  EXPECT_TRUE(is_certified(b, a, 0.15F));
  Draw draw(22);
  for (int trial = 0; trial < 400; ++trial) {
    a = cylinder(draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F), 2);
    b = cylinder(draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F), 2);
    const float tilt = std::pow(10.0F, draw.between(-7.0F, -1.0F));
    a.pose.q = draw.turn();
    b.pose.q = tilted(a.pose.q, tilt * draw.between(-1.0F, 1.0F), tilt * draw.between(-1.0F, 1.0F));
    const float beside = draw.between(-0.1F, 0.1F);
    const float apart = a.shape.half_length_m + b.shape.half_length_m + draw.between(-0.02F, 0.1F);
    b.pose.x = a.pose.x + turned(turned_axes(a.pose.q), {beside, 0.0F, apart});
    ASSERT_TRUE(is_certified(a, b, 0.15F)) << "trial " << trial << "\n" << text_of(a) << "\n" << text_of(b);
    ASSERT_TRUE(is_certified(b, a, 0.15F)) << "trial " << trial << ", swapped\n" << text_of(b) << "\n" << text_of(a);
  }
}

TEST(Cylinders, OfSpecialPositionsAreCertified) {
  Draw draw(2);
  for (int trial = 0; trial < 600; ++trial) {
    const auto size = [&] { return 0.25F * static_cast<float>(1 + draw.below(4)); };
    const auto at = [&] { return 0.25F * static_cast<float>(draw.below(9) - 4); };
    Subject a = cylinder(size(), size(), draw.below(3));
    Subject b = cylinder(size(), size(), draw.below(3));
    if (trial % 4 == 0) b = sphere(size());
    if (trial % 4 == 1) b = capsule(size(), size(), draw.below(3));
    if (trial % 4 == 2) b = box({size(), size(), size()});
    a.pose = {{at(), at(), at()}, draw.quarter_turns()};
    b.pose = {{at(), at(), at()}, draw.quarter_turns()};
    ASSERT_TRUE(is_certified(a, b, 0.3F)) << "trial " << trial << "\n" << text_of(a) << "\n" << text_of(b);
  }
}

// A cylinder that stands on a box has four points that are spread around its end; one that lies has both ends of its
// line.
TEST(Cylinders, StandAndLie) {
  Subject floor = box({2.0F, 0.5F, 2.0F});
  Subject can = cylinder(0.5F, 1.0F, 1);
  can.pose.x = {0.25F, 1.5F, 0.0F};
  Manifold m[kPatchesOfPair];
  ASSERT_EQ(make_manifolds(can.shape, can.pose, floor.shape, floor.pose, 0.01F, m), 1);
  ASSERT_EQ(m[0].count, 4);
  double area = 0.0;  // of the triangles from the axis
  double angle[4];
  for (int k = 0; k < 4; ++k) angle[k] = std::atan2(m[0].points[k].point.z, m[0].points[k].point.x);
  std::sort(angle, angle + 4);
  for (int k = 0; k < 4; ++k) {
    const double next = k == 3 ? angle[0] + 2.0 * std::numbers::pi : angle[k + 1];
    area += 0.5 * 0.25 * std::sin(next - angle[k]);
  }
  EXPECT_NEAR(area, 0.5, 0.03) << "a square in the rim has twice the radius squared";
  can.pose.q = {std::sqrt(0.5F), 0.0F, 0.0F, std::sqrt(0.5F)};
  can.pose.x.y = 1.0F;
  ASSERT_EQ(make_manifolds(can.shape, can.pose, floor.shape, floor.pose, 0.01F, m), 1);
  ASSERT_EQ(m[0].count, 2);
  EXPECT_NEAR(std::abs(m[0].points[0].point.x - m[0].points[1].point.x), 2.0F, 1e-5F);
}

// For the convex mesh the engine has its triangles alone; the result is certified with its solid. The deepest point of
// a patch has the patch's normal.
TEST(Cylinders, BesideAMeshAreRound) {
  Draw draw(11);
  for (int trial = 0; trial < 40; ++trial) {
    Subject a = cylinder(draw.between(0.2F, 0.8F), draw.between(0.2F, 0.8F), draw.below(3));
    MeshBody mesh(random_hull(draw));
    Subject b = hull(mesh.mesh);
    a.pose = {draw.in_cube(1.0F), draw.turn()};
    b.pose.q = draw.turn();
    const Vec3 direction = normalized(draw.in_cube(1.0F));
    const double wanted = draw.between(1e-3F, 0.05F);
    double low = 0.0;
    double high = 4.0;
    for (int k = 0; k < 10; ++k) {
      b.pose.x = a.pose.x + static_cast<float>(0.5 * (low + high)) * direction;
      (widest_gap(a, b) < wanted ? low : high) = 0.5 * (low + high);
    }
    Manifold m[kPatchesOfPair];
    const int count = make_manifolds(a.shape, a.pose, mesh.shape, b.pose, 0.1F, m);
    ASSERT_GE(count, 1) << "trial " << trial;
    const double rounding = 6.0 * rounding_of(a, b);
    const float gap = deepest(m, count);
    const Point n = exact::to_point(m[0].normal);
    EXPECT_LE(widest_gap(a, b), gap + rounding) << "trial " << trial;
    EXPECT_NEAR(gap_along(a, b, n), gap, rounding) << "trial " << trial;
    for (int k = 0; k < m[0].count; ++k) {
      if (m[0].points[k].gap_m != gap) continue;
      const Point middle = at_world(a, m[0].points[k].point);
      // The normal of a point may be up to 8 degrees from the common one, as above.
      const double allowed = rounding + 0.5 * 0.1411 * std::abs(gap);
      EXPECT_LE(off(a, middle + (0.5 * gap) * n), allowed) << "trial " << trial;
      EXPECT_LE(off(b, middle - (0.5 * gap) * n), allowed) << "trial " << trial;
    }
  }
}

// A standing cylinder has points spread over its end; a lying one has them along its lowest line.
TEST(Cylinders, StandAndLieOnAFloorOfTriangles) {
  MeshBody floor(floor_mesh());
  Draw draw(12);
  for (int trial = 0; trial < 40; ++trial) {
    const bool stands = trial % 2 == 0;
    Subject can = cylinder(0.4F, 0.3F, 1);
    const float turn = draw.between(0.0F, 3.0F);
    const Quat about_y{std::cos(0.5F * turn), 0.0F, std::sin(0.5F * turn), 0.0F};
    const float half = std::sqrt(0.5F);
    // The axis along x first, then turned about y.
    const Quat lying{half * about_y.w, half * about_y.y, half * about_y.y, -half * about_y.w};
    can.pose.q = stands ? about_y : lying;
    const float depth = draw.between(-0.004F, 0.004F);
    can.pose.x = {draw.between(-1.0F, 1.0F), (stands ? 0.3F : 0.4F) - depth, draw.between(-1.0F, 1.0F)};
    Manifold m[kPatchesOfPair];
    ASSERT_EQ(make_manifolds(can.shape, can.pose, floor.shape, floor.pose, 0.01F, m), 1) << "trial " << trial;
    EXPECT_NEAR(m[0].normal.y, 1.0F, 1e-5F);
    const double rounding =
        3.0 * contact_rounding_m(placed_shape(can.shape, can.pose, {}), placed_shape(floor.shape, floor.pose, {}));
    EXPECT_NEAR(deepest(m, 1), -depth, rounding) << "trial " << trial;
    float low = 0.0F, high = 0.0F;  // along the axis of one that lies, along x of one that stands
    const Vec3 along = stands ? Vec3{1, 0, 0} : rotate(can.pose.q, {0, 1, 0});
    for (int k = 0; k < m[0].count; ++k) {
      const float at = dot(m[0].points[k].point, along);
      low = std::min(low, at), high = std::max(high, at);
      // Beside the line, the edge of a triangle is met in a direction up to 8 degrees (0.99) from the normal.
      EXPECT_LE(m[0].points[k].gap_m, -depth + (stands ? 0.0 : 0.4 * (1.0 / 0.99 - 1.0)) + rounding) << trial;
    }
    // Both ends of the line have a point. Before, rounding chose the deepest one of points that are level, and all
    // others kept were between it and the farther end.
    EXPECT_GT(high - low, stands ? 0.5F : 0.6F - 1e-3F) << "trial " << trial;
  }
}

}  // namespace
}  // namespace broadside::core

// The first touch of bodies that move and turn: closed answers, and against sampling in small steps.
#include "core/exact/rigid_touch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/exact/moving_pair.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/capsule_mesh.hpp"
#include "datasets/shapes/convex_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside::exact {
namespace {

// A bracket is as wide as the tolerance of 1e-9 of the sizes, divided by speeds of about 1; overlap is certain from a
// depth of 1e-8 on.
constexpr double kNarrow = 1e-6;

core::Mesh box(double x, double y, double z) {
  return datasets::box_mesh({x, y, z}, {1, 1, 1}).value();
}

RigidMotion motion(core::Vec3 from, Point displacement_m, Point rotation_rad = {}) {
  return {{from, {}}, displacement_m, rotation_rad};
}

void expect_touch_at(const RigidTouch& found, double t, double width = kNarrow) {
  EXPECT_EQ(found.meeting, Meeting::kTouch);
  EXPECT_LE(found.lower, t);
  EXPECT_GE(found.upper, t);
  EXPECT_LT(found.upper - found.lower, width);
}

// |d + v t| = r1 + r2.
double touch_of_spheres(Point d, Point v, double radii) {
  const double a = dot(v, v), b = dot(d, v), c = dot(d, d) - radii * radii;
  return (-b - std::sqrt(b * b - a * c)) / a;
}

TEST(RigidTouch, TwoFastSpheres) {
  const MovingShape one(datasets::sphere_mesh(0.5, 8).value(), true);
  const MovingShape two(datasets::sphere_mesh(0.25, 8).value(), true);
  const Point v{-200.0, 3.0, 1.0};
  const RigidTouch found = first_touch(one, motion({100, 0, 0}, v), two, motion({0, 1.25F, 0}, {}, {0, 9, 0}));
  expect_touch_at(found, touch_of_spheres({100, -1.25, 0}, v, 0.75), 1e-9);
  EXPECT_LT(found.measurements, 60U);
  EXPECT_EQ(first_touch(one, motion({100, 0, 0}, {-200, 0, 0}), two, motion({0, 1.25F, 0}, {})).meeting,
            Meeting::kApart);
}

// A needle of half length r, level, at a height d above a plate that its tip reaches after turning by asin(d / r): the
// tip is the middle of its lower edge at the end, so the needle's own half thickness e comes in as an angle atan(e/r).
TEST(RigidTouch, ANeedleThatTurnsThroughAPlate) {
  const double r = 1.0, e = 0.0078125, d = 0.75, turn = 2.0;
  const core::Mesh needle = box(2 * r, 2 * e, 2 * e);
  const core::Mesh plate = box(8, 0.5, 8);
  const double tip = std::hypot(r, e);
  const double expected = (std::asin(d / tip) - std::atan2(e, r)) / turn;
  for (const bool as_solid : {true, false}) {
    const RigidTouch found = first_touch(MovingShape(needle, as_solid), motion({0, 1, 0}, {}, {0, 0, turn}),
                                         MovingShape(plate, as_solid), motion({0, 0, 0}, {}));
    expect_touch_at(found, expected);
    EXPECT_LT(found.measurements, 100U);
  }
  // It turns by 2 pi in the step: at the end the needle is where it was, and samples at the two ends do not see that it
  // went through.
  const RigidTouch whole = first_touch(MovingShape(needle, true), motion({0, 1, 0}, {}, {0, 0, 2 * std::numbers::pi}),
                                       MovingShape(plate, true), motion({0, 0, 0}, {}));
  expect_touch_at(whole, expected * turn / (2 * std::numbers::pi));
}

TEST(RigidTouch, BoxesThatFallTouchStandOrPass) {
  const core::Mesh cube = box(1, 1, 1);
  for (const bool as_solid : {true, false}) {
    const MovingShape shape(cube, as_solid);
    const RigidMotion still = motion({0, 0, 0}, {});
    expect_touch_at(first_touch(shape, motion({0.25F, 3, 0}, {0, -4, 0}), shape, still), 0.5);
    expect_touch_at(first_touch(shape, motion({0, 500, 0}, {0, -1000, 0}), shape, still), 0.499, 1e-9);
    EXPECT_EQ(first_touch(shape, motion({0, 3, 0}, {0, -1.5, 0}), shape, still).meeting, Meeting::kApart);
    EXPECT_EQ(first_touch(shape, motion({1.25F, 3, 0}, {0, -6, 0}), shape, still).meeting, Meeting::kApart);
    // Face on face at the start, and then away. For solids rounding decides whether they touch, and the answer says so;
    // for triangles exact predicates decide.
    const RigidTouch away = first_touch(shape, motion({0, 1, 0}, {0, 1, 0}), shape, still);
    EXPECT_EQ(away.meeting, as_solid ? Meeting::kGraze : Meeting::kTouch);
    EXPECT_EQ(away.lower, 0.0);
    // It turns a quarter and back up: the corner's arc is lowest at 45 degrees, 0.7071 below the middle.
    const RigidMotion turns = motion({0, 1.25F, 0}, {}, {0, 0, std::numbers::pi / 2});
    EXPECT_EQ(first_touch(shape, turns, shape, still).meeting, Meeting::kApart) << "0.5 + 0.7071 < 1.25";
    const RigidMotion lower = motion({0, 1.1875F, 0}, {}, {0, 0, std::numbers::pi / 2});
    const double angle = std::asin(0.6875 / std::sqrt(0.5)) - std::numbers::pi / 4;
    expect_touch_at(first_touch(shape, lower, shape, still), angle / (std::numbers::pi / 2));
  }
  const MovingShape solid(cube, true);
  const RigidTouch deep = first_touch(solid, motion({0, 0.5F, 0}, {0, 9, 0}), solid, motion({0, 0, 0}, {}));
  EXPECT_EQ(deep.meeting, Meeting::kTouch);
  EXPECT_EQ(deep.lower, 0.0);
  EXPECT_EQ(deep.upper, 0.0);
}

// One cube over the other at a height of 2^-20 m, which is 550 times the tolerance of 1e-9 of both cubes' sizes.
TEST(RigidTouch, AMillionthApartIsApart) {
  const core::Mesh cube = box(1, 1, 1);
  for (const bool as_solid : {true, false}) {
    const MovingShape shape(cube, as_solid);
    const RigidTouch over = first_touch(shape, motion({-2, 1 + 0x1p-20F, 0}, {4, 0, 0}), shape, motion({0, 0, 0}, {}));
    EXPECT_EQ(over.meeting, Meeting::kApart) << over.lower;
  }
}

// 2000 samples a step see no overlap before `lower`, and one at `upper`; where they see any, there is a touch.
TEST(RigidTouch, SamplingFindsNothingEarlierAndNothingMissed) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> at(-1.0F, 1.0F);
  const core::Mesh meshes[] = {box(0.75, 0.5, 1), datasets::capsule_mesh(0.25, 0.5, 8).value(),
                               datasets::convex_mesh({0.75, 1, 0.5}, 10, 7).value(),
                               datasets::sphere_mesh(0.375, 8).value()};
  int met = 0;
  int apart = 0;
  double measurements = 0;
  const int trials = 160;
  for (int trial = 0; trial < trials; ++trial) {
    const bool as_solid = trial % 4 != 0;
    const MovingShape a(meshes[random() % (as_solid ? 4 : 1)], as_solid);
    const MovingShape b(meshes[as_solid ? random() % 4 : 2], as_solid);
    const auto some_motion = [&](float side) {
      RigidMotion m =
          motion({side + at(random), at(random), at(random)}, {-3.0 * side + at(random), at(random), at(random)},
                 {3.0 * at(random), 3.0 * at(random), 3.0 * at(random)});
      m.start.orientation = {at(random), at(random), at(random), at(random)};
      return m;
    };
    const RigidMotion motion_a = some_motion(1.0F);
    const RigidMotion motion_b = some_motion(-1.0F);
    const RigidTouch found = first_touch(a, motion_a, b, motion_b);
    measurements += found.measurements;
    const auto pair = as_solid ? solid_pair(a, motion_a, b, motion_b) : surface_pair(a, motion_a, b, motion_b);
    const int samples = as_solid ? 1000 : 100;
    bool overlap = false;
    for (int k = 0; k <= samples && !overlap; ++k) {
      const double t = static_cast<double>(k) / samples;
      overlap = pair->overlap_at(t);
      if (overlap) {
        ASSERT_NE(found.meeting, Meeting::kApart) << "trial " << trial;
        ASSERT_GE(t, found.lower) << "trial " << trial << ": late";
      }
    }
    if (found.meeting == Meeting::kTouch) {
      ASSERT_TRUE(pair->overlap_at(found.upper)) << "trial " << trial;
      EXPECT_LT(found.upper - found.lower, 1e-4) << "trial " << trial;
    }
    met += found.meeting == Meeting::kTouch ? 1 : 0;
    apart += found.meeting == Meeting::kApart ? 1 : 0;
  }
  EXPECT_GT(met, trials / 4);
  EXPECT_GT(apart, trials / 8);
  EXPECT_LT(measurements / trials, 120.0);
  RecordProperty("measurements_each", std::to_string(measurements / trials));
}

}  // namespace
}  // namespace broadside::exact

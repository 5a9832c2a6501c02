// The box of a body that moves and turns: closed answers, and every place of a vertex lies inside it.
#include "core/exact/swept_box.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace broadside::exact {
namespace {

using core::Vec3;

RigidMotion at_rest() {
  RigidMotion motion;
  motion.start.orientation = {1, 0, 0, 0};
  return motion;
}

TEST(SweptBox, WithoutTurningItIsThatOfBothEnds) {
  RigidMotion motion = at_rest();
  motion.displacement_m = {3, -2, 0};
  const std::vector<Vec3> vertices{{0, 0, 0}, {1, 1, 1}};
  const core::Box box = swept_box(vertices, motion);
  const float expected[2][3] = {{0, -2, 0}, {4, 1, 1}};
  for (int k = 0; k < 3; ++k) {
    EXPECT_LE(box.min[k], expected[0][k]);
    EXPECT_GE(box.max[k], expected[1][k]);
    EXPECT_NEAR(box.min[k], expected[0][k], 1e-6);
    EXPECT_NEAR(box.max[k], expected[1][k], 1e-6);
  }
}

// From -30 degrees by 100 degrees: the arc passes 0 degrees, where x is 1, and ends before 90, where y would be 1: at
// sin 70 degrees.
TEST(SweptBox, AnArcReachesFartherThanItsEnds) {
  RigidMotion motion = at_rest();
  const double start = -std::numbers::pi / 6.0;
  motion.rotation_rad = {0, 0, std::numbers::pi * 100.0 / 180.0};
  const std::vector<Vec3> vertices{{static_cast<float>(std::cos(start)), static_cast<float>(std::sin(start)), 0}};
  const core::Box box = swept_box(vertices, motion);
  EXPECT_NEAR(box.max.x, 1.0, 1e-6);
  EXPECT_NEAR(box.min.x, std::cos(70.0 * std::numbers::pi / 180.0), 1e-6);
  EXPECT_NEAR(box.max.y, std::sin(70.0 * std::numbers::pi / 180.0), 1e-6);
  EXPECT_NEAR(box.min.y, -0.5, 1e-6);
  EXPECT_NEAR(box.max.z, 0.0, 1e-12);
}

// A wheel's rim (a cycloid): x = t - sin t, y = 1 - cos t over one turn from the ground, and back to it.
TEST(SweptBox, ARollingWheel) {
  RigidMotion motion = at_rest();
  motion.start.position = {0, 1, 0};
  motion.displacement_m = {2.0 * std::numbers::pi, 0, 0};
  motion.rotation_rad = {0, 0, -2.0 * std::numbers::pi};
  const core::Box box = swept_box(std::vector<Vec3>{{0, -1, 0}}, motion);
  EXPECT_NEAR(box.min.x, 0.0, 1e-6);
  EXPECT_NEAR(box.max.x, 2.0 * std::numbers::pi, 1e-6);
  EXPECT_NEAR(box.min.y, 0.0, 1e-6);
  EXPECT_NEAR(box.max.y, 2.0, 1e-6);
}

TEST(SweptBox, ContainsEveryPlaceAndIsTight) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto lot = [&](double size) { return Point{size * unit(random), size * unit(random), size * unit(random)}; };
  constexpr int kPlaces = 4000;
  for (int trial = 0; trial < 100; ++trial) {
    RigidMotion motion = at_rest();
    motion.start.orientation = {static_cast<float>(unit(random)), static_cast<float>(unit(random)),
                                static_cast<float>(unit(random)), static_cast<float>(unit(random))};
    motion.start.position = {static_cast<float>(unit(random)), static_cast<float>(unit(random)), 1.0F};
    motion.displacement_m = lot(trial % 3 == 0 ? 0.1 : 3.0);
    motion.rotation_rad = lot(trial % 2 == 0 ? 1.0 : 8.0);
    const std::vector<Vec3> vertices{{1, 0.5F, 0}, {0, -1, 0.25F}};
    const core::Box box = swept_box(vertices, motion);
    double low[3] = {9, 9, 9};
    double high[3] = {-9, -9, -9};
    for (int step = 0; step <= kPlaces; ++step)
      for (const Vec3 v : vertices) {
        const Placement at = placement_at(motion, static_cast<double>(step) / kPlaces);
        const Point p = at.origin + at.turned({v.x, v.y, v.z});
        const double x[3] = {p.x, p.y, p.z};
        for (int k = 0; k < 3; ++k) {
          ASSERT_LE(box.min[k], x[k]);
          ASSERT_GE(box.max[k], x[k]);
          low[k] = std::min(low[k], x[k]);
          high[k] = std::max(high[k], x[k]);
        }
      }
    // Between two places a turn of at most 14 rad bends a path by 14^2 / (8 n^2) of its radius of at most 1.2.
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(box.min[k], low[k], 4e-6);
      EXPECT_NEAR(box.max[k], high[k], 4e-6);
    }
  }
}

}  // namespace
}  // namespace broadside::exact

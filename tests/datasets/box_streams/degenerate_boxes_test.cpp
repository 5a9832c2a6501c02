// Each degenerate set is degenerate in the way that its name says, and has the pairs that arithmetic gives.
#include "datasets/box_streams/degenerate_boxes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace broadside {
namespace {

using core::Box;

std::uint64_t pair_count(const std::vector<Box>& boxes) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j) count += core::overlaps(boxes[i], boxes[j]) ? 1 : 0;
  return count;
}

TEST(IdenticalBoxes, AllOverlap) {
  EXPECT_EQ(pair_count(datasets::identical_boxes(200)), 200U * 199U / 2U);
}

// Per axis a cube has w - 1 neighbor pairs in either order and itself w times, so 3 w - 2 ordered pairs; over three
// axes (3 w - 2)^3 ordered pairs with w^3 of a cube and itself.
TEST(TouchingBoxes, TouchAndNeverOverlapByMore) {
  const auto boxes = datasets::touching_boxes(9 * 9 * 9);
  EXPECT_EQ(pair_count(boxes), (25U * 25U * 25U - 9U * 9U * 9U) / 2U);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      bool is_open = true;
      for (int k = 0; k < 3; ++k)
        is_open = is_open && boxes[i].min[k] < boxes[j].max[k] && boxes[j].min[k] < boxes[i].max[k];
      ASSERT_FALSE(is_open) << i << " " << j;
    }
}

// Centers uniform in 0 to L are within h of each other with probability 2 h / L - h^2 / L^2, and h is 1 on average, its
// square 1 + 1/24; the other axes always overlap. 4000 pairs or so: ten deviations of a count that is nearly Poisson.
TEST(LineBoxes, OverlapEightOthersOnOneAxis) {
  constexpr double kCount = 4000;
  const double width = kCount / 4.0;
  const double expected = 0.5 * kCount * (kCount - 1) * (2.0 / width - (1.0 + 1.0 / 24.0) / (width * width));
  const auto boxes = datasets::line_boxes(4000, 1);
  EXPECT_NEAR(static_cast<double>(pair_count(boxes)), expected, 10.0 * std::sqrt(expected));
  for (const Box& b : boxes) ASSERT_TRUE(b.min.y < 0.0F && b.max.y > 0.0F && b.min.z < 0.0F && b.max.z > 0.0F);
}

TEST(PlaneBoxes, OverlapEightOthersOnTwoAxes) {
  constexpr double kCount = 4000;
  const double width = std::sqrt(kCount / 2.0);
  const double one_axis = 2.0 / width - (1.0 + 1.0 / 24.0) / (width * width);
  const double expected = 0.5 * kCount * (kCount - 1) * one_axis * one_axis;
  EXPECT_NEAR(static_cast<double>(pair_count(datasets::plane_boxes(4000, 1))), expected, 10.0 * std::sqrt(expected));
}

TEST(FlatBoxes, ArePointsSegmentsAndSquares) {
  const auto boxes = datasets::flat_boxes(3000, 1);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const core::Vec3 sides = boxes[i].max - boxes[i].min;
    ASSERT_EQ(sides, (core::Vec3{i % 3 == 0 ? 0.0F : 1.0F, i % 3 == 2 ? 1.0F : 0.0F, 0.0F}));
  }
  EXPECT_GT(pair_count(boxes), 3000U);
}

TEST(FarBoxes, LieOnTheStepsOfAFloat) {
  for (const Box& b : datasets::far_boxes(1000, 1))
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(b.min[k], 999'999.0F);
      ASSERT_EQ(b.min[k] * 16.0F, std::floor(b.min[k] * 16.0F));
    }
}

TEST(TinyBoxes, AreAMillionthOfTheirSize) {
  for (const Box& b : datasets::tiny_boxes(1000, 1))
    for (int k = 0; k < 3; ++k) {
      const double side = double{b.max[k]} - double{b.min[k]};
      ASSERT_GE(side, 0.499e-6);
      ASSERT_LE(side, 1.501e-6);
    }
}

TEST(SubnormalBoxes, HaveNoNormalCoordinateAndOverlapLikeUniformOnes) {
  const auto boxes = datasets::subnormal_boxes(2000, 1);
  for (const Box& b : boxes)
    for (int k = 0; k < 3; ++k) {
      ASSERT_FALSE(std::isnormal(b.min[k]));
      ASSERT_FALSE(std::isnormal(b.max[k]));
      ASSERT_LT(b.min[k], b.max[k]);
    }
  const double width = std::cbrt(2000.0);
  const double one_axis = 2.0 / width - (1.0 + 1.0 / 24.0) / (width * width);
  const double expected = 0.5 * 2000 * 1999 * one_axis * one_axis * one_axis;
  EXPECT_NEAR(static_cast<double>(pair_count(boxes)), expected, 10.0 * std::sqrt(expected));
}

}  // namespace
}  // namespace broadside

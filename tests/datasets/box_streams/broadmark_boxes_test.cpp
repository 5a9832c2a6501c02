// Broadmark's numbers: density, start, speeds, what moves and what comes to rest.
#include "datasets/box_streams/broadmark_boxes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace broadside {
namespace {

using core::Box;
using datasets::BoxStream;

constexpr std::uint32_t kBroadmarkCount = 2000;
const double kWidth = std::cbrt(kBroadmarkCount / 0.1);

BoxStream stream_of(const std::string& scene) {
  auto stream = datasets::make_box_stream("broadmark-" + scene + ":" + std::to_string(kBroadmarkCount));
  EXPECT_TRUE(stream.ok()) << stream.error().line();
  return stream.ok() ? std::move(stream).value() : BoxStream{};
}

double distance(core::Vec3 a, core::Vec3 b) {
  return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
}

std::vector<Box> next(BoxStream& stream, std::vector<Box> boxes) {
  EXPECT_TRUE(stream.advance(boxes).ok());
  return boxes;
}

TEST(Broadmark, StartsInABallAtATenthOfAnObjectAUnitOfVolume) {
  for (const char* scene : {"brownian:cubes", "freefall:spheres", "gravity:assorted"}) {
    const BoxStream stream = stream_of(scene);
    ASSERT_EQ(stream.boxes.size(), kBroadmarkCount) << scene;
    EXPECT_EQ(stream.frames, 300U);
    const auto half = static_cast<float>(0.5 * kWidth);
    double mean = 0.0;
    for (const Box& b : stream.boxes) {
      const double r = distance(core::center(b), {half, half, half});
      ASSERT_LE(r, 0.45 * kWidth + 1e-5) << scene;
      mean += r / kBroadmarkCount;
    }
    // Uniform in a ball: the mean distance is 3/4 of the radius, its deviation sqrt(3/80) of it.
    EXPECT_NEAR(mean / (0.45 * kWidth), 0.75, 5.0 * std::sqrt(3.0 / 80.0 / kBroadmarkCount)) << scene;
  }
}

TEST(Broadmark, SidesAreThoseOfItsObjects) {
  for (const Box& b : stream_of("brownian:spheres").boxes)
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(b.max[k] - b.min[k], 1.0F, 1e-5F);
  for (const Box& b : stream_of("brownian:assorted").boxes)
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(b.max[k] - b.min[k], 0.0999F);
      ASSERT_LE(b.max[k] - b.min[k], 1.9001F);
    }
}

// A unit cube's box is 1 to sqrt(3) wide, whatever the rotation; after 2 s of tumbling few are axis-aligned.
TEST(Broadmark, CubesTumble) {
  BoxStream stream = stream_of("brownian:cubes");
  std::vector<Box> boxes = stream.boxes;
  for (int frame = 0; frame < 60; ++frame) boxes = next(stream, boxes);
  int wider = 0;
  for (const Box& b : boxes)
    for (int k = 0; k < 3; ++k) {
      const float side = b.max[k] - b.min[k];
      ASSERT_GE(side, 0.9999F);
      ASSERT_LE(side, 1.7322F);
      wider += side > 1.05F ? 1 : 0;
    }
  EXPECT_GT(wider, 3 * static_cast<int>(kBroadmarkCount) / 2);
}

// In one frame the first 1 % change their velocity; the others fly on along a straight line, unless a wall was near.
TEST(Broadmark, BrownianStirsOnePercentAFrame) {
  BoxStream stream = stream_of("brownian:spheres");
  const std::vector<Box> one = next(stream, stream.boxes);
  const std::vector<Box> two = next(stream, one);
  int bent = 0;
  for (std::size_t n = 0; n < kBroadmarkCount; ++n) {
    const core::Vec3 a = core::center(stream.boxes[n]);
    const core::Vec3 b = core::center(one[n]);
    const core::Vec3 c = core::center(two[n]);
    ASSERT_LE(distance(a, b), 0.75 * kWidth / 30.0 * std::sqrt(3.0) + 1e-4);
    bent += distance(c, b + (b - a)) > 1e-3 ? 1 : 0;
  }
  // The 20 that the second frame changes. Most of the rest are farther from every wall than they fly in two frames.
  EXPECT_GE(bent, 20);
  EXPECT_LE(bent, 60);
}

TEST(Broadmark, FreefallFallsByGravityAndThenLiesStill) {
  BoxStream stream = stream_of("freefall:spheres");
  std::vector<Box> boxes = next(stream, stream.boxes);
  const std::vector<Box> two = next(stream, boxes);
  // The two steps differ by g dt^2 alone, except for the few boxes that the velocity's cap or a wall affects.
  int falling = 0;
  for (std::size_t n = 0; n < kBroadmarkCount; ++n) {
    const double bend = double{two[n].min.y} - 2.0 * boxes[n].min.y + stream.boxes[n].min.y;
    falling += std::abs(bend + 9.81 / 900.0) < 1e-4 ? 1 : 0;
  }
  EXPECT_GT(falling, 9 * static_cast<int>(kBroadmarkCount) / 10);
  boxes = two;
  for (std::uint32_t frame = 2; frame + 10 < stream.frames; ++frame) boxes = next(stream, boxes);
  const std::vector<Box> late = boxes;
  for (int frame = 0; frame < 9; ++frame) boxes = next(stream, boxes);
  int still = 0;
  for (std::size_t n = 0; n < kBroadmarkCount; ++n) {
    still += boxes[n] == late[n] ? 1 : 0;
    ASSERT_GE(boxes[n].min.y, -1e-5F);
  }
  EXPECT_EQ(still, static_cast<int>(kBroadmarkCount));
}

TEST(Broadmark, GravityPullsAllOneWayAndTurns) {
  BoxStream stream = stream_of("gravity:spheres");
  std::vector<std::vector<Box>> frames{stream.boxes};
  for (int frame = 0; frame < 6; ++frame) frames.push_back(next(stream, frames.back()));
  const auto pull = [&](int frame) {
    core::Vec3 sum;
    int free = 0;
    for (std::size_t n = 0; n < kBroadmarkCount; ++n) {
      const core::Vec3 bend = (core::center(frames[frame + 2][n]) - core::center(frames[frame + 1][n])) -
                              (core::center(frames[frame + 1][n]) - core::center(frames[frame][n]));
      if (core::length(bend) > 0.1F) continue;  // turned round at a wall
      sum = sum + bend;
      ++free;
    }
    return (1.0F / static_cast<float>(free)) * sum;
  };
  // 4 g dt^2, less what the velocity's cap withholds from a few.
  const core::Vec3 first = pull(0);
  const core::Vec3 later = pull(4);
  EXPECT_NEAR(core::length(first), 4.0 * 9.81 / 900.0, 0.1 * 4.0 * 9.81 / 900.0);
  // The turn of 1.94 degrees a frame about an axis near y swings it out of -x; four frames make 7.7 degrees.
  EXPECT_LT(first.x, 0.0F);
  EXPECT_LT(core::dot(first, later) / (core::length(first) * core::length(later)), std::cos(0.07F));
}

}  // namespace
}  // namespace broadside

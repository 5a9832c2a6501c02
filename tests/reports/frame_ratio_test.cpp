#include "reports/frame_ratio.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace broadside::reports {
namespace {

// Frames that grow longer along the run, on a core that is now and then 1.7 times slower, for both builds alike.
std::vector<double> run_of(std::size_t frames, double factor) {
  std::vector<double> seconds;
  for (std::size_t k = 0; k < frames; ++k)
    seconds.push_back(factor * (1.0 + 0.01 * static_cast<double>(k)) * (k / 7 % 3 == 0 ? 1.7 : 1.0));
  return seconds;
}

TEST(FrameRatio, WhatSlowsBothAtOneMomentCancels) {
  EXPECT_DOUBLE_EQ(frame_ratio(run_of(150, 1.0), run_of(150, 1.1)), 1.1);
  EXPECT_DOUBLE_EQ(frame_ratio(run_of(3, 2.0), run_of(3, 1.0)), 0.5);
  EXPECT_DOUBLE_EQ(frame_ratio({1.0}, {1.25}), 1.25);
}

TEST(FrameRatio, DisturbedFramesDoNotCount) {
  std::vector<double> head = run_of(150, 1.1);
  for (std::size_t k = 3; k < head.size(); k += 5) head[k] *= 9.0;
  EXPECT_DOUBLE_EQ(frame_ratio(run_of(150, 1.0), head), 1.1);
}

// The last quarter of a run of equal frames takes 1.4 times as long: the run takes 1.1 times as long, while the median
// frame does not change.
TEST(FrameRatio, AChangeOfAPartOfTheRunCountsByItsShare) {
  const std::vector<double> base(160, 1.0);
  std::vector<double> head = base;
  for (std::size_t k = 120; k < head.size(); ++k) head[k] = 1.4;
  EXPECT_NEAR(frame_ratio(base, head), 1.1, 1e-12);
}

// A frame whose base time is zero has no ratio; a run without any ratio counts as unchanged.
TEST(FrameRatio, FramesWithoutATimeAreLeftOut) {
  std::vector<double> base = run_of(150, 1.0);
  for (std::size_t k = 0; k < 40; ++k) base[k] = 0.0;
  EXPECT_DOUBLE_EQ(frame_ratio(base, run_of(150, 1.1)), 1.1);
  EXPECT_EQ(frame_ratio({0.0, 0.0}, {1.0, 1.0}), 1.0);
}

}  // namespace
}  // namespace broadside::reports

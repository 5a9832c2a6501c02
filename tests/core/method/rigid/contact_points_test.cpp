#include "core/method/rigid/contact_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace broadside::core {
namespace {

std::vector<std::uint32_t> kept_of(const std::vector<ManifoldPoint>& candidates, float reach_m) {
  Manifold out;
  out.normal = {0.0F, 1.0F, 0.0F};
  keep_four_by<OneLane>(
      out, static_cast<int>(candidates.size()), reach_m, kTurnOfStep,
      [&](int k) { return candidates[static_cast<std::size_t>(k)]; }, [](int) { return true; });
  std::vector<std::uint32_t> features;
  for (int k = 0; k < out.count; ++k) features.push_back(out.points[k].feature);
  return features;
}

bool has(const std::vector<std::uint32_t>& features, std::uint32_t feature) {
  return std::find(features.begin(), features.end(), feature) != features.end();
}

// A card of 1 m by 0.5 m by 2 cm stands on the edge of its lower side at x = -0.5 and comes down about it. Corners 1
// and 2 are the ends of that edge, 3 and 4 the other ones of the lower side, 5 to 8 the upper side's above 1 to 4.
// While the card leans, corners 5 and 6 are farther out than 1 and 2. Before, one of them was kept, and the card stood
// on a single corner.
TEST(KeepFour, ACardThatComesDownStandsOnItsEdge) {
  constexpr float kThick_m = 0.02F;
  for (int step = 0; step <= 120; ++step) {
    const float angle = 0.001F * static_cast<float>(step);
    const auto at = [&](float along, float up, float z, std::uint32_t feature) {
      const float x = along * std::cos(angle) - up * std::sin(angle);
      const float y = along * std::sin(angle) + up * std::cos(angle);
      return ManifoldPoint{{x - 0.5F, 0.5F * y, z}, y, feature};
    };
    std::vector<ManifoldPoint> corners;
    std::uint32_t feature = 0;
    for (const float up : {0.0F, kThick_m})
      for (const float along : {0.0F, 1.0F})
        for (const float z : {-0.25F, 0.25F}) corners.push_back(at(along, up, z, ++feature));
    const auto kept = kept_of(corners, 0.2F);
    EXPECT_TRUE(has(kept, 1) && has(kept, 2)) << angle;
    EXPECT_TRUE(has(kept, 3) && has(kept, 4)) << angle;
  }
}

// Of two candidates at nearly the same place the deeper one is kept.
TEST(KeepFour, OfTwoAtOnePlaceTheDeeper) {
  std::mt19937 bits(7);
  const auto in = [&](float least, float most) { return std::uniform_real_distribution<float>(least, most)(bits); };
  for (int n = 0; n < 1000; ++n) {
    std::vector<ManifoldPoint> candidates;
    for (std::uint32_t k = 0; k < 4; ++k) {
      const float x = (k & 1U) != 0 ? 1.0F : -1.0F;
      const float z = (k & 2U) != 0 ? 1.0F : -1.0F;
      const float gap = in(0.0F, 0.01F);
      candidates.push_back({{x, 0.0F, z}, gap, 1 + k});
      const float farther = 1.0F + in(0.0F, 1e-3F);
      candidates.push_back({{farther * x, 0.0F, farther * z}, gap + in(0.005F, 0.1F), 5 + k});
    }
    for (const std::uint32_t feature : kept_of(candidates, 1.0F)) EXPECT_LE(feature, 4U) << n;
  }
}

// The corners of a bunny that stands on two of them (x and z about its center, gap, m). When areas alone decided, the
// second one, which lies between the others, was left out, and the bunny rolled over it.
TEST(KeepFour, WhatABodyStandsOnIsKeptBetweenHigherCorners) {
  const std::vector<ManifoldPoint> corners = {{{-0.513F, -0.311F, -0.289F}, -0.000158F, 1},
                                              {{0.154F, -0.312F, 0.103F}, -0.0000075F, 2},
                                              {{0.174F, -0.306F, 0.319F}, 0.0110F, 3},
                                              {{0.375F, -0.294F, 0.026F}, 0.0357F, 4},
                                              {{0.348F, -0.251F, -0.171F}, 0.1202F, 5}};
  EXPECT_TRUE(has(kept_of(corners, 0.27F), 2));
}

// A candidate may lie deeper than the plane of three kept ones. Here four corners lie around a fifth one, which is near
// the middle and only a little higher than the first: the fifth one is kept.
TEST(KeepFour, ACornerBelowThePlaneOfTheOthersIsKept) {
  const std::vector<ManifoldPoint> corners = {{{0.0F, 0.0F, 0.0F}, 0.0F, 1},
                                              {{1.0F, 0.0F, 0.0F}, 0.030F, 2},
                                              {{0.0F, 0.0F, 1.0F}, 0.030F, 3},
                                              {{1.0F, 0.0F, 1.0F}, 0.060F, 4},
                                              {{0.45F, 0.0F, 0.45F}, 0.001F, 5}};
  const auto kept = kept_of(corners, 0.2F);
  EXPECT_EQ(kept.size(), 4U);
  EXPECT_TRUE(has(kept, 1) && has(kept, 5));
}

}  // namespace
}  // namespace broadside::core

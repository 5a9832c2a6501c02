// The fast first touch against the exact one: no touch is missed or late, and hardly any is early or made up.
#include "core/continuous/feature_impact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/exact/feature_touch.hpp"
#include "tests/core/exact/moving_cases.hpp"

namespace broadside::continuous {
namespace {

using core::Vec3d;

struct Account {
  int touching = 0;
  int made_up = 0;
  std::vector<double> early;

  double median_early() {
    std::nth_element(early.begin(), early.begin() + static_cast<std::ptrdiff_t>(early.size() / 2), early.end());
    return early[early.size() / 2];
  }
};

// What the method promises for every query.
void hold_against_exact(const MovingFeatures& f, Account& account) {
  const Impact fast = first_impact(f);
  const exact::TouchTime truth = exact::first_touch(f);
  if (!truth.touches) {
    account.made_up += fast.touches ? 1 : 0;
    return;
  }
  ++account.touching;
  ASSERT_TRUE(fast.touches) << "missed, at " << truth.lower;
  ASSERT_LE(fast.time, truth.upper) << "late";
  account.early.push_back(truth.lower - fast.time);
}

TEST(FeatureImpact, GeneralMotions) {
  std::mt19937_64 random(31);
  Account account;
  for (int trial = 0; trial < 20000; ++trial)
    ASSERT_NO_FATAL_FAILURE(hold_against_exact(tests::general_features(random), account)) << "trial " << trial;
  EXPECT_GT(account.touching, 2000);
  EXPECT_LE(account.made_up, 2) << "features that pass each other nearer than rounding are rare";
  EXPECT_LT(account.median_early(), 1e-12);
  EXPECT_LT(*std::max_element(account.early.begin(), account.early.end()), 1e-6);
}

// Parallel edges, all points in one plane or on one line, edges and triangles that are points, standstill, grazing.
TEST(FeatureImpact, DegenerateMotions) {
  std::mt19937_64 random(32);
  Account account;
  for (int trial = 0; trial < 20000; ++trial)
    ASSERT_NO_FATAL_FAILURE(hold_against_exact(tests::lattice_features(random), account)) << "trial " << trial;
  EXPECT_GT(account.touching, 5000);
  EXPECT_LE(account.made_up, account.touching / 1000);
  EXPECT_LT(account.median_early(), 1e-12);
}

// Units from 2^-900 m to 2^900 m, and features far from the origin, where few digits are left.
TEST(FeatureImpact, ScalesAndOffsets) {
  std::mt19937_64 random(33);
  for (const double scale : {0x1p-1060, 0x1p-900, 0x1p-70, 0x1p70, 0x1p900}) {
    Account account;
    for (int trial = 0; trial < 500; ++trial) {
      MovingFeatures f = tests::some_features(random);
      for (int k = 0; k < 4; ++k) {
        f.start[k] = scale * f.start[k];
        f.end[k] = scale * f.end[k];
      }
      ASSERT_NO_FATAL_FAILURE(hold_against_exact(f, account)) << "trial " << trial << " at " << scale;
    }
    EXPECT_GT(account.touching, 50);
    EXPECT_LT(account.median_early(), 1e-9);
  }
  Account account;
  for (int trial = 0; trial < 2000; ++trial) {
    MovingFeatures f = tests::some_features(random);
    const Vec3d offset{1e9, -1e12, 1e6};
    for (int k = 0; k < 4; ++k) {
      f.start[k] = f.start[k] + offset;
      f.end[k] = f.end[k] + offset;
    }
    ASSERT_NO_FATAL_FAILURE(hold_against_exact(f, account)) << "trial " << trial << " far away";
  }
  EXPECT_GT(account.touching, 200);
}

TEST(FeatureImpact, ClosedAnswers) {
  const MovingFeatures falls{FeatureKind::kVertexFace,
                             {{0.25, 0.25, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                             {{0.25, 0.25, -2}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_NEAR(first_impact(falls).time, 1.0 / 3.0, 1e-13);
  EXPECT_LE(first_impact(falls).time, 1.0 / 3.0);
  MovingFeatures passes = falls;
  passes.start[0] = {0.75, 0.75, 1};
  passes.end[0] = {0.75, 0.75, -2};
  EXPECT_EQ(first_impact(passes), Impact{});
  // The plane z = t (x + y) turns toward the vertex (t/2, t/2, 1/2): t^2 = 1/2.
  const MovingFeatures turns{FeatureKind::kVertexFace,
                             {{0, 0, 0.5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                             {{0.5, 0.5, 0.5}, {0, 0, 0}, {1, 0, 1}, {0, 1, 1}}};
  EXPECT_NEAR(first_impact(turns).time, std::sqrt(0.5), 1e-13);
  EXPECT_LE(first_impact(turns).time, std::sqrt(0.5));
}

}  // namespace
}  // namespace broadside::continuous

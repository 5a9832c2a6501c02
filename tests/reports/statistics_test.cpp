// Summaries against closed forms.
#include "reports/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace broadside::reports {
namespace {

// 0, 1, ... 100 in scrambled order: the p-th percentile is p, the mean 50, the sample variance n (n + 1) / 12 with n =
// 101.
TEST(Statistics, PercentilesOfZeroToHundredAreTheirOwnNumbers) {
  std::vector<double> values;
  for (int k = 0; k <= 100; ++k) values.push_back((k * 37) % 101);
  const Summary s = summarize(values);
  EXPECT_EQ(s.count, 101U);
  EXPECT_DOUBLE_EQ(s.min, 0);
  EXPECT_DOUBLE_EQ(s.p5, 5);
  EXPECT_DOUBLE_EQ(s.q1, 25);
  EXPECT_DOUBLE_EQ(s.median, 50);
  EXPECT_DOUBLE_EQ(s.q3, 75);
  EXPECT_DOUBLE_EQ(s.p95, 95);
  EXPECT_DOUBLE_EQ(s.max, 100);
  EXPECT_DOUBLE_EQ(s.mean, 50);
  EXPECT_NEAR(s.deviation, std::sqrt(101.0 * 102.0 / 12.0), 1e-12);
  EXPECT_DOUBLE_EQ(s.relative_spread, 1.0);
}

// Between order statistics: of {0, 10}, a quarter of the way is 2.5.
TEST(Statistics, QuantilesInterpolateLinearly) {
  const Summary s = summarize(std::vector<double>{10.0, 0.0});
  EXPECT_DOUBLE_EQ(s.median, 5.0);
  EXPECT_DOUBLE_EQ(s.q1, 2.5);
  EXPECT_DOUBLE_EQ(s.p95, 9.5);
}

TEST(Statistics, EqualValuesHaveNoSpread) {
  const Summary s = summarize(std::vector<double>(7, 0.25));
  EXPECT_EQ(s.median, 0.25);
  EXPECT_EQ(s.deviation, 0.0);
  EXPECT_EQ(s.relative_spread, 0.0);
}

TEST(Statistics, OneValueHasInfiniteSpreadNotAFlatteringZero) {
  const Summary s = summarize(std::vector<double>{3.0});
  EXPECT_EQ(s.median, 3.0);
  EXPECT_TRUE(std::isinf(s.deviation));
  EXPECT_TRUE(std::isinf(s.relative_spread));
}

TEST(Statistics, NoValueIsNotANumberRatherThanZero) {
  const Summary s = summarize({});
  EXPECT_EQ(s.count, 0U);
  EXPECT_TRUE(std::isnan(s.median));
  EXPECT_TRUE(std::isnan(s.mean));
}

TEST(Statistics, ValuesThatAreNotFiniteAreCountedApart) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Summary s = summarize(std::vector<double>{1.0, nan, 3.0, infinity});
  EXPECT_EQ(s.count, 2U);
  EXPECT_EQ(s.not_finite, 2U);
  EXPECT_DOUBLE_EQ(s.median, 2.0);
}

}  // namespace
}  // namespace broadside::reports

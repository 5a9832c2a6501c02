// Change points are found where they were put and nowhere else; the test behind them agrees with printed tables.
#include "reports/change_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/pair.hpp"

namespace broadside::reports {
namespace {

std::vector<double> noise(std::size_t count, double mean, double deviation, std::uint64_t seed) {
  std::vector<double> values;
  std::uint64_t state = seed << 32U;
  const auto uniform = [&] { return static_cast<double>((core::splitmix64(++state) >> 11U) + 1U) * 0x1.0p-53; };
  for (std::size_t k = 0; k < count; ++k)
    values.push_back(mean +
                     deviation * std::sqrt(-2.0 * std::log(uniform())) * std::cos(2.0 * std::numbers::pi * uniform()));
  return values;
}

std::vector<double> joined(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Student's t table (Fisher and Yates): the two-sided 5 %, 1 % and 0.1 % points.
TEST(Student, PrintedTable) {
  EXPECT_NEAR(student_two_sided(12.706, 1), 0.05, 1e-5);
  EXPECT_NEAR(student_two_sided(2.228, 10), 0.05, 1e-4);
  EXPECT_NEAR(student_two_sided(2.845, 20), 0.01, 1e-5);
  EXPECT_NEAR(student_two_sided(3.646, 30), 0.001, 1e-6);
  EXPECT_DOUBLE_EQ(student_two_sided(0.0, 7), 1.0);
  // One degree of freedom is Cauchy's distribution: 1 - 2 atan(t) / pi.
  for (const double t : {0.1, 1.0, 3.0, 50.0})
    EXPECT_NEAR(student_two_sided(t, 1), 1.0 - 2.0 * std::atan(t) / std::numbers::pi, 1e-12);
}

TEST(Welch, SetsWithoutSpread) {
  const std::vector<double> one{3, 3, 3};
  const std::vector<double> other{4, 4, 4};
  EXPECT_EQ(welch_p(one, one), 1.0);
  EXPECT_EQ(welch_p(one, other), 0.0);
  EXPECT_EQ(welch_p(one, std::vector<double>{4}), 1.0);
}

TEST(ChangePoints, OneStepIsFoundWhereItIs) {
  const auto values = joined(noise(30, 10.0, 0.2, 1), noise(30, 11.0, 0.2, 2));
  const std::vector<ChangePoint> found = change_points(values);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(static_cast<double>(found[0].index), 30.0, 1.0);
  EXPECT_NEAR(found[0].before, 10.0, 0.1);
  EXPECT_NEAR(found[0].after, 11.0, 0.1);
}

TEST(ChangePoints, UpAndDownAgainAreTwo) {
  const auto values = joined(joined(noise(20, 5.0, 0.1, 3), noise(15, 6.0, 0.1, 4)), noise(20, 5.0, 0.1, 5));
  const std::vector<ChangePoint> found = change_points(values);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].index, 20U);
  EXPECT_EQ(found[1].index, 35U);
}

// A counter has no noise: any lasting step is a change point.
TEST(ChangePoints, ACounterStepsExactly) {
  std::vector<double> values(8, 1000.0);
  values.insert(values.end(), 4, 1001.0);
  const std::vector<ChangePoint> found = change_points(values);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].index, 8U);
  EXPECT_EQ(found[0].p, 0.0);
}

TEST(ChangePoints, OneBadNightIsNoChange) {
  auto values = noise(40, 10.0, 0.2, 6);
  values[17] = 30.0;
  EXPECT_TRUE(change_points(values).empty());
  EXPECT_TRUE(change_points(std::vector<double>(50, 7.0)).empty());
  EXPECT_TRUE(change_points({}).empty());
  EXPECT_TRUE(change_points(std::vector<double>{1, 9}).empty());
}

// The largest of many splits is tested as if it were the only one, so more than 0.1 % of series of pure noise are
// split; the requirement is at most 5 %.
TEST(ChangePoints, PureNoiseIsSeldomSplit) {
  int split = 0;
  for (std::uint64_t seed = 100; seed < 300; ++seed) split += change_points(noise(50, 1.0, 0.03, seed)).empty() ? 0 : 1;
  RecordProperty("split", split);
  EXPECT_LE(split, 10);
}

}  // namespace
}  // namespace broadside::reports

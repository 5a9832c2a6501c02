// The exponent of a power law against exact laws.
#include "reports/scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace broadside::reports {
namespace {

TEST(Scaling, AnExactLawIsFoundExactly) {
  std::vector<double> n;
  std::vector<double> t;
  for (const double count : {10.0, 100.0, 1000.0, 5000.0}) n.push_back(count), t.push_back(3e-6 * std::pow(count, 1.5));
  const PowerLaw law = fit_power_law(n, t);
  EXPECT_NEAR(law.exponent, 1.5, 1e-12);
  EXPECT_NEAR(law.low, 1.5, 1e-6);
  EXPECT_NEAR(law.high, 1.5, 1e-6);
}

// Three points off a line of slope 1 by -d, +2d, -d at x = -1, 0, 1: slope 1, residual sum 6 d^2, one degree of
// freedom, so the half interval is 12.706 * sqrt(6 d^2 / 2).
TEST(Scaling, TheIntervalIsThatOfLeastSquares) {
  const double d = 0.01;
  const std::vector<double> n{std::exp(-1.0), 1.0, std::exp(1.0)};
  const std::vector<double> t{std::exp(-1.0 - d), std::exp(2 * d), std::exp(1.0 - d)};
  const PowerLaw law = fit_power_law(n, t);
  EXPECT_NEAR(law.exponent, 1.0, 1e-12);
  EXPECT_NEAR(law.high - law.exponent, 12.706 * std::sqrt(3.0) * d, 1e-5);
  EXPECT_TRUE(std::isnan(fit_power_law({1, 2}, {1, 2}).low)) << "two points have no interval";
}

core::RunRows family() {
  core::RunRows rows;
  for (const int count : {50, 100, 200}) {
    const core::Stamp stamp{.scene_name = "freefall:sphere:" + std::to_string(count),
                            .scene_digest = static_cast<std::uint64_t>(count),
                            .engine = "e"};
    rows.cells.push_back({.stamp = stamp, .state = core::CellState::kRecorded, .frames = 1, .digests = {{1, 42}}});
    rows.verdicts.push_back({.stamp = stamp, .verdicts = {{.validator = "law", .outcome = core::Outcome::kPass}}});
    rows.samples.push_back(
        {.stamp = stamp, .stages = {{"frame", {1e-6 * count * count}}}, .final_digest = 42, .final_step = 1});
  }
  return rows;
}

TEST(Scaling, ScenesOfOneNameAndSeveralCountsAreAFamily) {
  const auto all = scaling_series(family());
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].family, "freefall:sphere");
  EXPECT_EQ(all[0].n, (std::vector<double>{50, 100, 200}));
  EXPECT_NEAR(all[0].law.exponent, 2.0, 1e-12);
}

TEST(Scaling, StruckOutTimesAndLoneScenesAreNone) {
  core::RunRows rows = family();
  for (core::CellVerdicts& v : rows.verdicts) v.verdicts[0].outcome = core::Outcome::kFail;
  EXPECT_TRUE(scaling_series(rows).empty());
  rows = family();
  rows.samples.resize(1);
  EXPECT_TRUE(scaling_series(rows).empty());
}

}  // namespace
}  // namespace broadside::reports

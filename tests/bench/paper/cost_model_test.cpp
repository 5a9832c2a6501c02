// Fits and crossovers against curves whose answer is known.
#include "bench/paper/cost_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace broadside::bench::paper {
namespace {

CostCurve curve_of(const std::string& method, double fixed_s, double linear_s, double quadratic_s, double noise = 0.0) {
  CostCurve curve{method, {300, 900, 3000, 9000, 30000}, {}};
  for (const double n : curve.counts) {
    const double t = fixed_s + linear_s * n + quadratic_s * n * n;
    curve.seconds.push_back({t * (1.0 - noise), t, t * (1.0 + noise)});
  }
  return curve;
}

TEST(CostFit, FindsTheTermsThatMadeTheCurve) {
  const auto fit = fit_cost(curve_of("flat", 2e-5, 3e-8, 4e-11));
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->fixed_s, 2e-5, 1e-10);
  EXPECT_NEAR(fit->linear_s, 3e-8, 1e-13);
  EXPECT_NEAR(fit->quadratic_s, 4e-11, 1e-16);
  EXPECT_LT(fit->worst_relative_error, 1e-8);
}

TEST(CostFit, ATermIsNeverNegative) {
  CostCurve falling = curve_of("strange", 0.0, 1e-6, 0.0);
  falling.seconds.back() = {5e-3, 5e-3};  // far less than linear: the best curve would bend down
  const auto fit = fit_cost(falling);
  ASSERT_TRUE(fit.has_value());
  EXPECT_GE(fit->fixed_s, 0.0);
  EXPECT_GE(fit->linear_s, 0.0);
  EXPECT_EQ(fit->quadratic_s, 0.0);
  EXPECT_GT(fit->worst_relative_error, 0.1);
}

TEST(CostFit, ThreeUnknownsTakeThreeCounts) {
  CostCurve curve = curve_of("flat", 1e-5, 1e-8, 1e-11);
  for (std::size_t k = 2; k < 5; ++k) curve.seconds[k].clear();
  EXPECT_FALSE(fit_cost(curve).has_value());
}

TEST(CostFit, AsManyCountsAsTermsTestNothing) {
  CostCurve curve = curve_of("flat", 1e-5, 1e-8, 1e-11);
  for (std::size_t k = 3; k < 5; ++k) curve.seconds[k].clear();
  EXPECT_FALSE(fit_cost(curve)->is_tested());
  EXPECT_TRUE(fit_cost(curve_of("flat", 1e-5, 1e-8, 1e-11))->is_tested());
}

TEST(EffectiveDepth, NeedsAQuadraticTermThatCounts) {
  const auto brute = fit_cost(curve_of("flat", 0.0, 0.0, 64e-12));
  EXPECT_FALSE(effective_depth(*brute, *fit_cost(curve_of("tree", 1e-3, 1e-7, 1e-17))).has_value());
}

TEST(EffectiveDepth, IsThePowerOfEightBetweenQuadraticTerms) {
  const auto brute = fit_cost(curve_of("flat", 0.0, 0.0, 64e-12));
  const auto pruned = fit_cost(curve_of("octree, L = 2", 0.0, 1e-8, 1e-12));
  ASSERT_TRUE(brute && pruned);
  const auto depth = effective_depth(*brute, *pruned);
  ASSERT_TRUE(depth.has_value());
  EXPECT_NEAR(*depth, 2.0, 1e-6);
  EXPECT_FALSE(effective_depth(*brute, *fit_cost(curve_of("tree", 0.0, 1e-8, 0.0))).has_value());
}

// 1e-11 N^2 = 1e-8 N at N = 1000; both are straight in log-log, so interpolation is exact.
TEST(Crossover, LiesWhereTheCurvesMeet) {
  const std::vector<CostCurve> curves{curve_of("flat", 0.0, 0.0, 1e-11, 0.01), curve_of("tree", 0.0, 1e-8, 0.0, 0.01)};
  const auto found = crossovers(curves);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].early, "flat");
  EXPECT_EQ(found[0].late, "tree");
  EXPECT_NEAR(found[0].count, 1000.0, 1e-6);
  ASSERT_TRUE(found[0].low && found[0].high);
  EXPECT_LT(*found[0].low, 1000.0);
  EXPECT_GT(*found[0].high, 1000.0);
  // One per cent of a time moves the crossing of slopes 2 and 1 by one per cent.
  EXPECT_GT(*found[0].low, 960.0);
  EXPECT_LT(*found[0].high, 1040.0);
  EXPECT_DOUBLE_EQ(found[0].share, 1.0);
  const auto again = crossovers(curves);
  EXPECT_EQ(*again[0].low, *found[0].low) << "the draws are fixed";
}

TEST(Crossover, ThereIsNoneWhereOneLeadsThroughout) {
  EXPECT_TRUE(crossovers(std::vector<CostCurve>{curve_of("a", 0, 1e-8, 0), curve_of("b", 0, 2e-8, 0)}).empty());
  CostCurve absent = curve_of("c", 0, 0, 1e-11);
  for (auto& runs : absent.seconds) runs.clear();
  EXPECT_TRUE(crossovers(std::vector<CostCurve>{curve_of("a", 0, 1e-8, 0), absent}).empty());
}

TEST(Crossover, OneRunGivesNoInterval) {
  std::vector<CostCurve> curves{curve_of("flat", 0, 0, 1e-11), curve_of("tree", 0, 1e-8, 0)};
  for (CostCurve& curve : curves)
    for (auto& runs : curve.seconds) runs.resize(1);
  const auto found = crossovers(curves);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].low.has_value());
}

}  // namespace
}  // namespace broadside::bench::paper

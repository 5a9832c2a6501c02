// The intervals against closed forms.
#include "reports/ratio_interval.hpp"

#include <gtest/gtest.h>

#include "reports/time_ratio.hpp"

namespace broadside::reports {
namespace {

// Both medians lie within the values, so no resample can leave [min head / max base, max head / min base].
TEST(RatioInterval, HoldsTheEstimateAndStaysWithinTheExtremes) {
  const std::vector<ProcessRuns> base{{1.0}, {1.1}, {0.9}, {1.05}, {0.95}};
  const std::vector<ProcessRuns> head{{1.2}, {1.4}, {1.3}, {1.25}, {1.35}};
  const RatioInterval i = ratio_interval(base, head, 0.05);
  EXPECT_DOUBLE_EQ(i.estimate, 1.3);
  EXPECT_LE(i.low, i.estimate);
  EXPECT_GE(i.high, i.estimate);
  EXPECT_GE(i.low, 1.2 / 1.1);
  EXPECT_LE(i.high, 1.4 / 0.9);
  const RatioInterval again = ratio_interval(base, head, 0.05);
  EXPECT_EQ(i.low, again.low);
  EXPECT_EQ(i.high, again.high);
}

// A machine that slows down by a third while it measures: the two runs of a pair are slowed alike, so the ratio is
// exact.
TEST(RatioInterval, PairsCancelWhatDriftsForBoth) {
  std::vector<ProcessRuns> base;
  std::vector<ProcessRuns> head;
  std::vector<ProcessRuns> pairs;
  for (int k = 0; k < 10; ++k) {
    const double drift = 1.0 + k / 30.0;
    base.push_back({drift});
    head.push_back({1.1 * drift});
    pairs.push_back({head.back()[0] / base.back()[0]});
  }
  const RatioInterval paired = paired_interval(pairs, 0.05);
  EXPECT_NEAR(paired.low, 1.1, 1e-12);
  EXPECT_NEAR(paired.high, 1.1, 1e-12);
  const RatioInterval apart = ratio_interval(base, head, 0.05);
  EXPECT_LT(apart.low, 1.05);
  EXPECT_GT(apart.high, 1.15);
}

// Where processes differ and the runs of one process do not, more runs give no more information: the interval stays as
// wide.
TEST(RatioInterval, RunsOfOneProcessAreNoSubstituteForProcesses) {
  std::vector<ProcessRuns> few;
  std::vector<ProcessRuns> many;
  for (int k = 0; k < 6; ++k) {
    few.push_back({1.0 + 0.05 * k});
    many.push_back(ProcessRuns(20, 1.0 + 0.05 * k));
  }
  const RatioInterval a = ratio_interval(few, few, 0.05);
  const RatioInterval b = ratio_interval(many, many, 0.05);
  EXPECT_NEAR(b.high - b.low, a.high - a.low, 0.02);
}

// C(6, 3) = 20 orders leave a chance of 1 in 20, C(8, 4) = 70 one of 1 in 70; the line is 1 in 40.
TEST(RatioInterval, SmallestPOfSoManyProcesses) {
  EXPECT_DOUBLE_EQ(smallest_p(3, 3, false), 1.0 / 20.0);
  EXPECT_DOUBLE_EQ(smallest_p(4, 4, false), 1.0 / 70.0);
  EXPECT_DOUBLE_EQ(smallest_p(3, 5, false), 1.0 / 56.0);
  EXPECT_DOUBLE_EQ(smallest_p(5, 5, true), 1.0 / 32.0);
  EXPECT_DOUBLE_EQ(smallest_p(0, 9, false), 1.0);
  EXPECT_TRUE(enough_processes(4, 4, false));
  EXPECT_FALSE(enough_processes(3, 3, false));
  EXPECT_FALSE(enough_processes(5, 5, true));
  EXPECT_TRUE(enough_processes(6, 6, true));
}

// The example of Benjamini and Hochberg 1995, section 3.3: 15 p-values, of which q = 0.05 accepts the first four.
TEST(BenjaminiHochberg, ThePapersOwnExample) {
  const std::vector<double> p{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                              0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};
  const std::vector<bool> believed = benjamini_hochberg(p, 0.05);
  for (std::size_t k = 0; k < p.size(); ++k) EXPECT_EQ(believed[k], k < 4) << k;
  EXPECT_TRUE(benjamini_hochberg({}, 0.05).empty());
}

}  // namespace
}  // namespace broadside::reports

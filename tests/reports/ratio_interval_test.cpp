// The interval against closed forms, and the gate against itself: how often it cries wolf, how often it misses one.
#include "reports/ratio_interval.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "reports/comparison.hpp"
#include "tests/reports/sample_rows.hpp"

namespace broadside::reports {
namespace {

// Both medians lie within the values, so no resample can leave [min head / max base, max head / min base].
TEST(RatioInterval, HoldsTheEstimateAndStaysWithinTheExtremes) {
  const std::vector<ProcessRuns> base{{1.0}, {1.1}, {0.9}, {1.05}, {0.95}};
  const std::vector<ProcessRuns> head{{1.2}, {1.4}, {1.3}, {1.25}, {1.35}};
  const RatioInterval i = ratio_interval(base, head, false, 0.05);
  EXPECT_DOUBLE_EQ(i.estimate, 1.3);
  EXPECT_LE(i.low, i.estimate);
  EXPECT_GE(i.high, i.estimate);
  EXPECT_GE(i.low, 1.2 / 1.1);
  EXPECT_LE(i.high, 1.4 / 0.9);
  const RatioInterval again = ratio_interval(base, head, false, 0.05);
  EXPECT_EQ(i.low, again.low);
  EXPECT_EQ(i.high, again.high);
}

// A machine that slows down by a third while it measures: pairs see it on both sides, so the ratio is exact.
TEST(RatioInterval, PairsCancelWhatDriftsForBoth) {
  std::vector<ProcessRuns> base;
  std::vector<ProcessRuns> head;
  for (int k = 0; k < 10; ++k) {
    const double drift = 1.0 + k / 30.0;
    base.push_back({drift});
    head.push_back({1.1 * drift});
  }
  const RatioInterval paired = ratio_interval(base, head, true, 0.05);
  EXPECT_NEAR(paired.low, 1.1, 1e-12);
  EXPECT_NEAR(paired.high, 1.1, 1e-12);
  const RatioInterval apart = ratio_interval(base, head, false, 0.05);
  EXPECT_LT(apart.low, 1.05);
  EXPECT_GT(apart.high, 1.15);
}

// Where processes differ and the runs of one do not, more runs of them teach nothing: the interval stays as wide.
TEST(RatioInterval, RunsOfOneProcessAreNoSubstituteForProcesses) {
  std::vector<ProcessRuns> few;
  std::vector<ProcessRuns> many;
  for (int k = 0; k < 6; ++k) {
    few.push_back({1.0 + 0.05 * k});
    many.push_back(ProcessRuns(20, 1.0 + 0.05 * k));
  }
  const RatioInterval a = ratio_interval(few, few, false, 0.05);
  const RatioInterval b = ratio_interval(many, many, false, 0.05);
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

// The example of Benjamini and Hochberg 1995, section 3.3: 15 p-values, of which q = 0.05 believes the first four.
TEST(BenjaminiHochberg, ThePapersOwnExample) {
  const std::vector<double> p{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                              0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};
  const std::vector<bool> believed = benjamini_hochberg(p, 0.05);
  for (std::size_t k = 0; k < p.size(); ++k) EXPECT_EQ(believed[k], k < 4) << k;
  EXPECT_TRUE(benjamini_hochberg({}, 0.05).empty());
}

constexpr double kQuiet = 0.015;
constexpr double kBusy = 0.045;  // as seen on two cores that others use too

// Measurements as this kind of program gives them: processes that differ by `spread`, runs by 1 %, a machine that
// drifts by 6 % in slow waves, and one process in twenty that something disturbs.
class Machine {
 public:
  explicit Machine(std::uint64_t seed, double spread = kQuiet) : state_(seed << 20U), spread_(spread) {}

  ProcessRuns process(double seconds, double at) {
    const double drift = 1.0 + 0.03 * std::sin(at / 3.0 + phase_);
    const double disturbed = uniform() < 0.05 ? 1.0 + 0.3 * uniform() : 1.0;
    const double own = seconds * drift * disturbed * std::exp(spread_ * normal());
    ProcessRuns runs;
    for (int r = 0; r < 2; ++r) runs.push_back(own * std::exp(0.01 * normal()));
    return runs;
  }

 private:
  double uniform() { return static_cast<double>((core::splitmix64(++state_) >> 11U) + 1U) * 0x1.0p-53; }
  double normal() { return std::sqrt(-2.0 * std::log(uniform())) * std::cos(2.0 * std::numbers::pi * uniform()); }

  std::uint64_t state_;
  double spread_;
  double phase_ = uniform() * 6.0;
};

// Two builds in turns, ABBA, as compare --interleave runs them, as rows of one cell each: fifteen processes of each,
// and where they do not tell thirty and sixty, with intervals that allow for three looks.
Speed interleaved(std::uint64_t seed, double factor, double spread = kQuiet) {
  constexpr ComparisonOptions kThreeLooks{.looks = 3};
  Machine machine(seed, spread);
  const core::Stamp stamp{.scene_name = "s", .scene_digest = 1, .engine = "e", .settings = "k=v", .machine = "m"};
  core::RunRows base;
  base.cells.push_back({.stamp = stamp, .state = core::CellState::kRecorded, .frames = 1, .digests = {{1, 42}}});
  base.verdicts.push_back({.stamp = stamp, .verdicts = {{.validator = "law", .outcome = core::Outcome::kPass}}});
  core::RunRows head = base;
  double at = 0.0;
  for (std::uint64_t pair = 1; pair <= 60; ++pair) {
    for (const bool is_head : pair % 2 == 1 ? std::array{false, true} : std::array{true, false}) {
      for (const double s : machine.process(is_head ? factor : 1.0, at += 1.0))
        (is_head ? head : base)
            .samples.push_back(
                {.stamp = stamp, .process = pair, .stages = {{"frame", {s}}}, .final_digest = 42, .final_step = 1});
    }
    if (pair != 15 && pair != 30) continue;
    const Speed speed = compare(base, head, kThreeLooks).times.at(0).speed;
    if (speed != Speed::kInconclusive) return speed;
  }
  return compare(base, head, kThreeLooks).times.at(0).speed;
}

constexpr std::uint64_t kComparisons = 200;

TEST(Gate, OfTwoHundredComparisonsOfEqualBuildsAtMostFivePercentAlarm) {
  std::uint64_t alarms = 0;
  std::uint64_t same = 0;
  for (std::uint64_t seed = 1; seed <= kComparisons; ++seed) {
    const Speed speed = interleaved(seed, 1.0);
    alarms += speed == Speed::kSlower || speed == Speed::kFaster ? 1U : 0U;
    same += speed == Speed::kSame ? 1U : 0U;
  }
  RecordProperty("alarms", static_cast<int>(alarms));
  RecordProperty("same", static_cast<int>(same));
  EXPECT_LE(alarms, kComparisons * 5 / 100);
  EXPECT_GE(same, kComparisons * 90 / 100) << "a gate that is always unsure raises no alarm either";
}

TEST(Gate, ASlowdownOfTenPercentIsFoundNinetyFiveTimesInAHundred) {
  std::uint64_t found = 0;
  for (std::uint64_t seed = 1001; seed <= 1000 + kComparisons; ++seed)
    found += interleaved(seed, 1.1) == Speed::kSlower ? 1U : 0U;
  RecordProperty("found", static_cast<int>(found));
  EXPECT_GE(found, kComparisons * 95 / 100);
}

constexpr std::uint64_t kBusyComparisons = 100;  // they are longer

TEST(Gate, ABusyMachineCostsProcessesAndNoAnswers) {
  std::uint64_t alarms = 0;
  std::uint64_t found = 0;
  for (std::uint64_t seed = 3001; seed <= 3000 + kBusyComparisons; ++seed) {
    const Speed equal = interleaved(seed, 1.0, kBusy);
    alarms += equal == Speed::kSlower || equal == Speed::kFaster ? 1U : 0U;
    found += interleaved(seed + kBusyComparisons, 1.1, kBusy) == Speed::kSlower ? 1U : 0U;
  }
  RecordProperty("alarms", static_cast<int>(alarms));
  RecordProperty("found", static_cast<int>(found));
  EXPECT_LE(alarms, kBusyComparisons * 5 / 100);
  EXPECT_GE(found, kBusyComparisons * 95 / 100);
}

// A build that is slower by delta itself is the worst case of a false alarm: looking three times must not make it one
// more often than the 2.5 % of its tail, 3 % of chance added.
TEST(Gate, LookingAgainDoesNotFindMoreByChance) {
  std::uint64_t alarms = 0;
  for (std::uint64_t seed = 4001; seed <= 4000 + kBusyComparisons; ++seed)
    alarms += interleaved(seed, 1.05, kBusy) == Speed::kSlower ? 1U : 0U;
  RecordProperty("alarms", static_cast<int>(alarms));
  EXPECT_LE(alarms, kBusyComparisons * 55 / 1000);
}

// With no delta to hide behind, the interval itself is on trial: 2.5 % beyond each end, and 3 % for the small sample.
TEST(Gate, TheIntervalAloneAlarmsAboutAsOftenAsItSays) {
  std::uint64_t outside = 0;
  for (std::uint64_t seed = 2001; seed <= 2000 + kComparisons; ++seed) {
    Machine machine(seed);
    std::vector<ProcessRuns> base;
    std::vector<ProcessRuns> head;
    for (int k = 0; k < 10; ++k) {
      base.push_back(machine.process(1.0, 2.0 * k));
      head.push_back(machine.process(1.0, 2.0 * k + 1.0));
    }
    const RatioInterval i = ratio_interval(base, head, true, 0.0);
    outside += i.low > 1.0 || i.high < 1.0 ? 1U : 0U;
  }
  RecordProperty("outside", static_cast<int>(outside));
  EXPECT_LE(outside, kComparisons * 10 / 100);
}

}  // namespace
}  // namespace broadside::reports

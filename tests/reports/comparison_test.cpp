// What got worse is found and named; what only looks different is not.
#include "reports/comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/reports/sample_rows.hpp"

namespace broadside::reports {
namespace {

using core::Exit;
using core::Outcome;

// One cell, two verdicts, five runs of three frames at 10 ms.
core::RunRows one_cell() {
  const core::Stamp stamp{.scene_name = "s", .scene_digest = 1, .engine = "e", .settings = "k=v", .machine = "m"};
  core::RunRows rows;
  rows.cells.push_back({.stamp = stamp, .state = core::CellState::kRecorded, .frames = 3, .digests = {{3, 42}}});
  rows.verdicts.push_back({.stamp = stamp,
                           .verdicts = {{.validator = "law", .outcome = Outcome::kPass},
                                        {.validator = "set", .outcome = Outcome::kPass, .baseline = "all-pairs"}}});
  for (std::uint32_t r = 0; r < 5; ++r)
    rows.samples.push_back({.stamp = stamp,
                            .repetition = r,
                            .stages = {{"frame", std::vector<double>(3, 0.010 + 0.00001 * r)}},
                            .final_digest = 42,
                            .final_step = 3});
  return rows;
}

core::RunRows slowed(core::RunRows rows, double factor) {
  for (core::Sample& sample : rows.samples)
    for (core::StageSeries& series : sample.stages)
      for (double& s : series.seconds) s *= factor;
  return rows;
}

TEST(Comparison, ARunEqualsItself) {
  const core::RunRows rows = testing_rows::sample_rows();
  const Comparison c = compare(rows, rows);
  EXPECT_TRUE(c.changes.empty());
  EXPECT_EQ(c.exit(), Exit::kGood);
  EXPECT_EQ(c.still_failing, 2U);
  EXPECT_EQ(c.same_verdicts, 108U);
  for (const TimeRatio& t : c.times) EXPECT_EQ(t.speed, Speed::kNoDifferenceShown) << t.label << t.reason;
}

TEST(Comparison, AnotherBuildIsWhatIsCompared) {
  core::RunRows head = one_cell();
  for (core::Cell& cell : head.cells) cell.stamp.broadside_build = "2", cell.stamp.settings = "k=v,new=default";
  for (core::CellVerdicts& cell : head.verdicts)
    cell.stamp.broadside_build = "2", cell.stamp.settings = "k=v,new=default";
  for (core::Sample& sample : head.samples)
    sample.stamp.broadside_build = "2", sample.stamp.settings = "k=v,new=default";
  const Comparison c = compare(one_cell(), head);
  EXPECT_TRUE(c.changes.empty());
  EXPECT_EQ(c.same_verdicts, 2U);
  ASSERT_EQ(c.times.size(), 1U);
  EXPECT_EQ(c.times[0].speed, Speed::kNoDifferenceShown) << c.times[0].reason;
}

struct Step {
  Outcome was, is;
  ChangeKind kind;
  Exit exit;
};

TEST(Comparison, EachWayForAVerdictToChangeHasItsExitCode) {
  for (const Step& step : {Step{Outcome::kPass, Outcome::kFail, ChangeKind::kVerdictWorse, Exit::kFailed},
                           Step{Outcome::kInconclusive, Outcome::kFail, ChangeKind::kVerdictWorse, Exit::kFailed},
                           Step{Outcome::kNotApplicable, Outcome::kFail, ChangeKind::kVerdictWorse, Exit::kFailed},
                           Step{Outcome::kPass, Outcome::kInconclusive, ChangeKind::kVerdictWorse, Exit::kMissing},
                           Step{Outcome::kPass, Outcome::kNotApplicable, ChangeKind::kVerdictMissing, Exit::kMissing},
                           Step{Outcome::kFail, Outcome::kPass, ChangeKind::kVerdictBetter, Exit::kGood},
                           Step{Outcome::kNotApplicable, Outcome::kPass, ChangeKind::kVerdictBetter, Exit::kGood}}) {
    core::RunRows base = one_cell();
    core::RunRows head = one_cell();
    base.samples.clear();
    head.samples.clear();
    base.verdicts[0].verdicts[0].outcome = step.was;
    head.verdicts[0].verdicts[0].outcome = step.is;
    const Comparison c = compare(base, head);
    ASSERT_EQ(c.changes.size(), 1U);
    EXPECT_EQ(c.changes[0].kind, step.kind);
    EXPECT_EQ(c.changes[0].subject, "law");
    EXPECT_EQ(c.exit(), step.exit);
  }
}

TEST(Comparison, AVerdictThatIsGoneIsMissing) {
  core::RunRows head = one_cell();
  head.verdicts[0].verdicts.pop_back();
  const Comparison c = compare(one_cell(), head);
  ASSERT_EQ(c.changes.size(), 1U);
  EXPECT_EQ(c.changes[0].kind, ChangeKind::kVerdictMissing);
  EXPECT_EQ(c.changes[0].subject, "set against all-pairs");
  EXPECT_EQ(c.changes[0].is, "no verdict");
  EXPECT_EQ(c.exit(), Exit::kMissing);
}

TEST(Comparison, ACellThatVanishedOrWasLostIsMissing) {
  const Comparison vanished = compare(one_cell(), {});
  ASSERT_FALSE(vanished.changes.empty());
  EXPECT_EQ(vanished.changes[0].kind, ChangeKind::kCellVanished);
  EXPECT_EQ(vanished.exit(), Exit::kMissing);

  core::RunRows head = one_cell();
  head.cells[0].state = core::CellState::kTimedOut;
  head.cells[0].reason = "after 60 s";
  const Comparison lost = compare(one_cell(), head);
  ASSERT_EQ(lost.changes.size(), 2U);
  EXPECT_EQ(lost.changes[0].kind, ChangeKind::kCellLost);
  EXPECT_EQ(lost.changes[0].is, "timed out: after 60 s");
  EXPECT_EQ(lost.changes[1].kind, ChangeKind::kTimeLost);
}

TEST(Comparison, ACellThatIsNewIsNoRegression) {
  const Comparison c = compare({}, one_cell());
  EXPECT_EQ(c.exit(), Exit::kGood);
  ASSERT_FALSE(c.changes.empty());
  EXPECT_EQ(c.changes[0].kind, ChangeKind::kCellNew);
}

TEST(Comparison, AnotherSceneUnderTheSameNameIsSaid) {
  core::RunRows head = one_cell();
  head.cells[0].stamp.scene_digest = head.verdicts[0].stamp.scene_digest = 2;
  for (core::Sample& sample : head.samples) sample.stamp.scene_digest = 2;
  const Comparison c = compare(one_cell(), head);
  ASSERT_EQ(c.changes.size(), 1U);
  EXPECT_EQ(c.changes[0].kind, ChangeKind::kSceneChanged);
  ASSERT_EQ(c.times.size(), 1U);
  EXPECT_EQ(c.times[0].speed, Speed::kNotComparable);
}

TEST(Comparison, CorrectnessOutweighsSpeed) {
  core::RunRows head = slowed(one_cell(), 0.5);
  head.verdicts[0].verdicts[0].outcome = Outcome::kFail;
  const Comparison c = compare(one_cell(), head);
  EXPECT_EQ(c.exit(), Exit::kFailed);
  // Its time is struck out too, however fast.
  ASSERT_EQ(c.times.size(), 1U);
  EXPECT_EQ(c.times[0].speed, Speed::kNotComparable);
}

// All runs scaled by one factor: the ratio is that factor. Runs differ by at most 0.4 %, so its interval does too.
TEST(TimeRatio, AFactorIsFoundWithItsInterval) {
  const Comparison slower = compare(one_cell(), slowed(one_cell(), 1.25));
  ASSERT_EQ(slower.times.size(), 1U);
  EXPECT_NEAR(slower.times[0].ratio, 1.25, 1e-12);
  EXPECT_GE(slower.times[0].low, 1.25 * (1 - 0.004));
  EXPECT_LE(slower.times[0].high, 1.25 * (1 + 0.004));
  EXPECT_LT(slower.times[0].low, slower.times[0].high);
  EXPECT_EQ(slower.times[0].speed, Speed::kSlower);
  EXPECT_EQ(slower.exit(), Exit::kFailed);

  const Comparison faster = compare(one_cell(), slowed(one_cell(), 0.8));
  EXPECT_EQ(faster.times[0].speed, Speed::kFaster);
  EXPECT_EQ(faster.exit(), Exit::kGood);
}

TEST(TimeRatio, WithinTheSlackNoDifferenceIsClaimed) {
  EXPECT_EQ(compare(one_cell(), slowed(one_cell(), 1.03)).times[0].speed, Speed::kNoDifferenceShown);
  EXPECT_EQ(compare(one_cell(), slowed(one_cell(), 1.03), {.slack = 0.0}).times[0].speed, Speed::kSlower);
}

TEST(TimeRatio, OtherMachinesFramesOrTooFewRunsAreNotCompared) {
  const auto reason = [](const core::RunRows& head) { return compare(one_cell(), head).times.at(0).reason; };
  core::RunRows machine = one_cell();
  machine.cells[0].stamp.machine = machine.verdicts[0].stamp.machine = "n";
  for (core::Sample& sample : machine.samples) sample.stamp.machine = "n";
  EXPECT_EQ(reason(machine), "the machine is another one");
  core::RunRows frames = one_cell();
  for (core::Sample& sample : frames.samples) sample.stages[0].seconds.pop_back();
  EXPECT_NE(reason(frames).find("3 frames in the base and 2 in the head"), std::string::npos) << reason(frames);
  core::RunRows few = one_cell();
  few.samples.resize(2);
  EXPECT_NE(reason(few).find("too few runs"), std::string::npos) << reason(few);
}

// C(6, 3) = 20 orders leave a chance of 1 in 20, C(8, 4) = 70 one of 1 in 70; the line is 1 in 40.
TEST(TimeRatio, FourRunsAgainstFourAreEnoughAndThreeAgainstThreeAreNot) {
  EXPECT_FALSE(enough_runs(0, 100));
  EXPECT_FALSE(enough_runs(1, 39));  // C(40, 1) = 40 is not more than 40
  EXPECT_TRUE(enough_runs(1, 40));
  EXPECT_FALSE(enough_runs(3, 3));
  EXPECT_TRUE(enough_runs(3, 5));  // C(8, 3) = 56
  EXPECT_TRUE(enough_runs(4, 4));
  EXPECT_TRUE(enough_runs(1000, 1000));
}

// Both medians lie within the values, so no resample can leave [min head / max base, max head / min base].
TEST(TimeRatio, TheIntervalHoldsTheEstimateAndStaysWithinTheExtremes) {
  const std::vector<double> base{1.0, 1.1, 0.9, 1.05, 0.95};
  const std::vector<double> head{1.2, 1.4, 1.3, 1.25, 1.35};
  const Interval i = bootstrap_ratio(base, head);
  EXPECT_DOUBLE_EQ(i.estimate, 1.3);
  EXPECT_LE(i.low, i.estimate);
  EXPECT_GE(i.high, i.estimate);
  EXPECT_GE(i.low, 1.2 / 1.1);
  EXPECT_LE(i.high, 1.4 / 0.9);
  const Interval again = bootstrap_ratio(base, head);
  EXPECT_EQ(i.low, again.low);
  EXPECT_EQ(i.high, again.high);
}

TEST(ComparisonText, NamesEachChangeInALine) {
  core::RunRows head = slowed(one_cell(), 1.5);
  head.verdicts[0].verdicts[0].outcome = Outcome::kInconclusive;
  const std::string text = comparison_text(compare(one_cell(), head));
  EXPECT_NE(text.find("MISSING s e: law was pass, is inconclusive\n"), std::string::npos) << text;
  EXPECT_NE(text.find("SLOWER, head / base 1.5 ["), std::string::npos) << text;
  EXPECT_EQ(comparison_text(compare(one_cell(), one_cell())).find("Nothing got worse; 2 verdicts unchanged."), 0U);
}

}  // namespace
}  // namespace broadside::reports

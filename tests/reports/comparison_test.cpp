// What got worse is found and named; what only looks different is not.
#include "reports/comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "tests/reports/sample_rows.hpp"

namespace broadside::reports {
namespace {

using core::Exit;
using core::Outcome;

// One cell, two verdicts, five processes of one run of three frames at 10 ms.
core::RunRows one_cell() {
  const core::Stamp stamp{.scene_name = "s", .scene_digest = 1, .engine = "e", .settings = "k=v", .machine = "m"};
  core::RunRows rows;
  rows.cells.push_back({.stamp = stamp, .state = core::CellState::kRecorded, .frames = 3, .digests = {{3, 42}}});
  rows.verdicts.push_back({.stamp = stamp,
                           .verdicts = {{.validator = "law", .outcome = Outcome::kPass},
                                        {.validator = "set", .outcome = Outcome::kPass, .baseline = "all-pairs"}}});
  for (std::uint32_t r = 0; r < 5; ++r)
    rows.samples.push_back({.stamp = stamp,
                            .repetition = 0,
                            .process = 100 + r,
                            .stages = {{"frame", std::vector<double>(3, 0.010 + 0.00001 * r)}},
                            .final_digest = 42,
                            .final_step = 3});
  return rows;
}

// Other processes, `factor` times as long.
core::RunRows slowed(core::RunRows rows, double factor) {
  for (core::Sample& sample : rows.samples) sample.process += 1000;
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
  for (const TimeRatio& t : c.times) EXPECT_EQ(t.speed, Speed::kSame) << t.label << t.reason;
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
  EXPECT_EQ(c.times[0].speed, Speed::kSame) << c.times[0].reason;
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
  EXPECT_EQ(c.exit(), Exit::kMissing) << "no cell of the base's scene is left to compare with";
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

TEST(TimeRatio, WithinDeltaTheTimeIsTheSame) {
  EXPECT_EQ(compare(one_cell(), slowed(one_cell(), 1.03)).times[0].speed, Speed::kSame);
  EXPECT_EQ(compare(one_cell(), slowed(one_cell(), 1.03), {.delta = 0.0}).times[0].speed, Speed::kSlower);
}

TEST(TimeRatio, OtherMachinesOrFramesAreNotCompared) {
  const auto reason = [](const core::RunRows& head) { return compare(one_cell(), head).times.at(0).reason; };
  core::RunRows machine = one_cell();
  machine.cells[0].stamp.machine = machine.verdicts[0].stamp.machine = "n";
  for (core::Sample& sample : machine.samples) sample.stamp.machine = "n";
  EXPECT_EQ(reason(machine), "the machines differ");
  const Comparison c = compare(one_cell(), machine);
  ASSERT_EQ(c.remarks.size(), 1U);
  EXPECT_NE(comparison_text(c).find("NOTE    different machines: the base ran on m, the head on n"), std::string::npos);
  core::RunRows frames = one_cell();
  for (core::Sample& sample : frames.samples) sample.stages[0].seconds.pop_back();
  EXPECT_NE(reason(frames).find("3 frames in the base and 2 in the head"), std::string::npos) << reason(frames);
}

// Five runs of one process say nothing about the next process; nor do three processes.
TEST(TimeRatio, TooFewProcessesAreInconclusiveAndNoPass) {
  for (const std::uint64_t processes : {1U, 3U}) {
    core::RunRows base = one_cell();
    core::RunRows head = slowed(one_cell(), 2.0);
    for (core::RunRows* rows : {&base, &head})
      for (std::size_t r = 0; r < rows->samples.size(); ++r)
        rows->samples[r].process = (rows == &base ? 1 : 50) + r % processes;
    const Comparison c = compare(base, head);
    EXPECT_EQ(c.times.at(0).speed, Speed::kInconclusive);
    EXPECT_NE(c.times.at(0).reason.find("too few processes"), std::string::npos) << c.times.at(0).reason;
    EXPECT_EQ(c.exit(), Exit::kMissing);
  }
}

TEST(TimeRatio, AnIntervalAcrossTheLimitIsInconclusiveAndNoPass) {
  core::RunRows head = slowed(one_cell(), 1.05);
  for (std::size_t r = 0; r < head.samples.size(); ++r)
    for (double& s : head.samples[r].stages[0].seconds) s *= 1.0 + 0.02 * (static_cast<double>(r) - 2.0);
  const Comparison c = compare(one_cell(), head);
  EXPECT_EQ(c.times.at(0).speed, Speed::kInconclusive) << c.times.at(0).low << " " << c.times.at(0).high;
  EXPECT_EQ(c.exit(), Exit::kMissing);
}

TEST(Comparison, CountersGateOnAnyMachineWithoutTolerance) {
  core::RunRows base = one_cell();
  base.cells[0].counters = {{"box tests", 1'000'000}, {"nodes visited", 10}, {"launches", 5}};
  core::RunRows head = base;
  for (auto* stamp : {&head.cells[0].stamp, &head.verdicts[0].stamp}) stamp->machine = "another";
  head.cells[0].counters = {{"box tests", 1'000'001}, {"nodes visited", 9}};
  const Comparison c = compare(base, head);
  const auto kinds = [&] {
    std::vector<ChangeKind> found;
    for (const Change& change : c.changes)
      if (change.kind != ChangeKind::kTimeLost) found.push_back(change.kind);
    return found;
  }();
  EXPECT_EQ(kinds, (std::vector{ChangeKind::kMoreWork, ChangeKind::kCounterVanished, ChangeKind::kLessWork}));
  EXPECT_EQ(c.exit(), Exit::kFailed);
  EXPECT_NE(comparison_text(c).find("1 counter up"), std::string::npos) << comparison_text(c);

  core::RunRows shorter = base;
  shorter.cells[0].frames = 2;
  EXPECT_EQ(compare(base, shorter).exit(), Exit::kGood) << "fewer frames are other work, not less of the same";
}

// One change a run: the exit code is that of the worst change, so a second change could hide the first one's.
TEST(Comparison, EachWayForACounterToChangeHasItsExitCode) {
  struct Way {
    std::map<std::string, std::uint64_t> now;
    ChangeKind kind;
    Exit exit;
  };
  for (const Way& way : {Way{{}, ChangeKind::kCounterVanished, Exit::kMissing},
                         Way{{{"box tests", 11}}, ChangeKind::kMoreWork, Exit::kFailed},
                         Way{{{"box tests", 9}}, ChangeKind::kLessWork, Exit::kGood}}) {
    core::RunRows base = one_cell();
    base.samples.clear();
    core::RunRows head = base;
    base.cells[0].counters = {{"box tests", 10}};
    head.cells[0].counters.clear();
    for (const auto& [name, count] : way.now) head.cells[0].counters[name] = count;
    const Comparison c = compare(base, head);
    ASSERT_EQ(c.changes.size(), 1U);
    EXPECT_EQ(c.changes[0].kind, way.kind);
    EXPECT_EQ(c.exit(), way.exit);
  }
}

TEST(Comparison, AStageThatIsNoLongerTimedIsMissing) {
  core::RunRows base = one_cell();
  for (core::Sample& sample : base.samples) sample.stages.push_back({"broad", {0.001, 0.001, 0.001}});
  const Comparison c = compare(base, one_cell());
  ASSERT_EQ(c.changes.size(), 1U);
  EXPECT_EQ(c.changes[0].kind, ChangeKind::kSeriesVanished);
  EXPECT_EQ(c.exit(), Exit::kMissing);
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

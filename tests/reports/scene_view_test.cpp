// The arrangement of rows for reading, and the one sentence that sums them up.
#include "reports/scene_view.hpp"

#include <gtest/gtest.h>

#include "tests/reports/sample_rows.hpp"

namespace broadside::reports {
namespace {

using core::Outcome;

core::Stamp stamp(const std::string& engine) {
  return {.scene_name = "s", .scene_digest = 1, .engine = engine};
}

core::RunRows judged(Outcome outcome) {
  core::RunRows rows;
  rows.cells.push_back({.stamp = stamp("e"), .state = core::CellState::kRecorded, .trace_file = "e.h5"});
  rows.verdicts.push_back(
      {.trace_file = "e.h5",
       .stamp = stamp("e"),
       .verdicts = {{.validator = "law", .outcome = Outcome::kPass}, {.validator = "set", .outcome = outcome}}});
  return rows;
}

TEST(Headline, SaysWhatThereIs) {
  EXPECT_EQ(headline(by_scene({})), "Nothing was judged.");
  const core::RunRows pass = judged(Outcome::kPass);
  EXPECT_EQ(headline(by_scene(pass)), "All 2 verdicts passed on 1 trace.");
  const core::RunRows unsure = judged(Outcome::kInconclusive);
  EXPECT_EQ(headline(by_scene(unsure)), "Nothing failed, but 1 of 2 verdicts is inconclusive on e.");
  const core::RunRows fail = judged(Outcome::kFail);
  EXPECT_EQ(headline(by_scene(fail)), "1 of 2 verdicts failed on e: set.");
  core::RunRows absent = judged(Outcome::kPass);
  absent.cells.push_back({.stamp = stamp("gpu"), .state = core::CellState::kNotMeasured, .reason = "no device"});
  EXPECT_EQ(headline(by_scene(absent)), "All 2 verdicts passed on 1 trace; 1 cell was not measured.");
  core::RunRows nothing = judged(Outcome::kNotApplicable);
  nothing.verdicts[0].verdicts.erase(nothing.verdicts[0].verdicts.begin());
  EXPECT_EQ(headline(by_scene(nothing)), "No validator applied, so nothing was proven.");
}

TEST(SceneView, VerdictsOfOneTraceAgainstSeveralBaselinesShareALine) {
  core::RunRows rows = judged(Outcome::kNotApplicable);  // "set" needs a baseline
  rows.verdicts.push_back(rows.verdicts[0]);
  rows.verdicts[1].verdicts[1] = {.validator = "set", .outcome = Outcome::kPass, .baseline = "a"};
  rows.verdicts.push_back(rows.verdicts[0]);
  rows.verdicts[2].verdicts[1] = {.validator = "set", .outcome = Outcome::kFail, .baseline = "b"};
  const std::vector<SceneView> scenes = by_scene(rows);
  ASSERT_EQ(scenes.size(), 1U);
  ASSERT_EQ(scenes[0].traces.size(), 1U);
  const TraceView& trace = scenes[0].traces[0];
  EXPECT_EQ(trace.baselines, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(trace.verdicts[0].size(), 1U);  // three equal verdicts are shown once
  ASSERT_EQ(trace.verdicts[1].size(), 2U);  // "not applicable" was settled by the baselines
  EXPECT_EQ(trace.verdicts[1][0]->outcome, Outcome::kFail);
  EXPECT_EQ(trace.verdicts[1][1]->outcome, Outcome::kPass);
  EXPECT_EQ(tally(scenes).failed, 1U);
  EXPECT_EQ(tally(scenes).passed, 2U);
}

TEST(SceneView, CellsWithoutVerdictsSayWhy) {
  core::RunRows rows = judged(Outcome::kPass);
  rows.verdicts.clear();
  rows.cells.push_back({.stamp = stamp("gpu"), .state = core::CellState::kUnsupported, .reason = "no contacts"});
  const std::vector<SceneView> scenes = by_scene(rows);
  EXPECT_EQ(scenes[0].traces[0].absence(), "recorded, not judged");
  EXPECT_EQ(scenes[0].traces[1].absence(), "unsupported: no contacts");
}

TEST(SceneView, TracesOfOneLabelAreToldApartByTheirFiles) {
  core::RunRows rows = judged(Outcome::kPass);
  rows.cells.push_back(rows.cells[0]);
  rows.cells[1].trace_file = "again.h5";
  const std::vector<SceneView> scenes = by_scene(rows);
  ASSERT_EQ(scenes[0].traces.size(), 2U);
  EXPECT_EQ(scenes[0].traces[0].label, "e (e.h5)");
  EXPECT_EQ(scenes[0].traces[1].label, "e (again.h5)");
}

TEST(SceneView, ScenesAreApartAndSharedNotesAreFactsOfTheScene) {
  core::RunRows rows = judged(Outcome::kPass);
  rows.cells[0].notes = {{"dt", "1/60 s"}, {"own", "x"}};
  rows.cells.push_back({.stamp = stamp("f"), .state = core::CellState::kRecorded, .notes = {{"dt", "1/60 s"}}});
  core::Stamp other = stamp("e");
  other.scene_digest = 2;
  rows.cells.push_back({.stamp = other, .state = core::CellState::kRecorded});
  const std::vector<SceneView> scenes = by_scene(rows);
  ASSERT_EQ(scenes.size(), 2U);
  EXPECT_EQ(scenes[0].traces.size(), 2U);
  EXPECT_EQ(scenes[0].facts, (std::map<std::string, std::string>{{"dt", "1/60 s"}}));
}

}  // namespace
}  // namespace broadside::reports

// A time counts only with a proof: each way in which the proof can be missing strikes the time out and is named.
#include "reports/admission.hpp"

#include <gtest/gtest.h>

#include "reports/timing.hpp"

namespace broadside::reports {
namespace {

// One recorded cell, one passing verdict, one sample whose answer is the recording's.
core::RunRows proven() {
  const core::Stamp stamp{.scene_name = "s", .scene_digest = 1, .engine = "e", .settings = "k=v", .machine = "m"};
  core::RunRows rows;
  rows.cells.push_back({.stamp = stamp, .state = core::CellState::kRecorded, .frames = 10, .digests = {{10, 42}}});
  rows.verdicts.push_back({.stamp = stamp, .verdicts = {{.validator = "law", .outcome = core::Outcome::kPass}}});
  rows.samples.push_back({.stamp = stamp,
                          .stages = {{"broad", {0.001, 0.003}}, {"frame", {0.002, 0.006}}},
                          .final_digest = 42,
                          .final_step = 10});
  return rows;
}

void expect_refused(const core::RunRows& rows, const std::string& why) {
  const Admission admission = admit(rows.samples[0], rows);
  EXPECT_FALSE(admission.is_admitted);
  EXPECT_NE(admission.reason.find(why), std::string::npos) << admission.reason;
}

TEST(Admission, ASampleWithARecordingAPassAndTheSameAnswerIsAdmitted) {
  const core::RunRows rows = proven();
  const Admission admission = admit(rows.samples[0], rows);
  EXPECT_TRUE(admission.is_admitted);
  EXPECT_EQ(admission.reason, "");
  EXPECT_EQ(admission.caveat, "");
}

TEST(Admission, WithoutARecordingItIsStruckOut) {
  core::RunRows rows = proven();
  rows.cells.clear();
  expect_refused(rows, "no recording of the same stamp");
}

TEST(Admission, ARecordingThatDiffersInOneThingIsNoProofAndTheThingIsNamed) {
  const std::vector<std::pair<std::string, void (*)(core::Stamp&)>> changes{
      {"scene", [](core::Stamp& s) { s.scene_digest = 2; }},
      {"engine", [](core::Stamp& s) { s.engine = "f"; }},
      {"settings", [](core::Stamp& s) { s.settings = "k=w"; }},
      {"engine's build", [](core::Stamp& s) { s.engine_build = "2"; }},
      {"build", [](core::Stamp& s) { s.broadside_build = "2"; }},
      {"machine", [](core::Stamp& s) { s.machine = "n"; }}};
  for (const auto& [name, change] : changes) {
    core::RunRows rows = proven();
    change(rows.cells[0].stamp);
    expect_refused(rows, "differs in its " + name);
  }
}

TEST(Admission, ANameIsNoPartOfTheStamp) {
  core::RunRows rows = proven();
  rows.cells[0].stamp.scene_name = "renamed";
  rows.cells[0].stamp.settings_short = "other";
  EXPECT_TRUE(admit(rows.samples[0], rows).is_admitted);
}

TEST(Admission, ACrashedRecordingIsNoProof) {
  core::RunRows rows = proven();
  rows.cells[0].state = core::CellState::kCrashed;
  rows.cells[0].reason = "signal 6";
  expect_refused(rows, "crashed: signal 6");
}

TEST(Admission, OneFailedVerdictStrikesOutEvenBesidePassingOnes) {
  core::RunRows rows = proven();
  rows.verdicts.push_back(rows.verdicts[0]);
  rows.verdicts[1].verdicts[0] = {
      .validator = "other-law", .outcome = core::Outcome::kFail, .worst = {.step = 7, .bodies = {1, 2}, .field = ""}};
  expect_refused(rows, "other-law failed on this stamp (worst at step 7, bodies 1 and 2)");
}

TEST(Admission, AFailureOfAnotherStampDoesNotMatter) {
  core::RunRows rows = proven();
  rows.verdicts.push_back(rows.verdicts[0]);
  rows.verdicts[1].stamp.settings = "k=w";
  rows.verdicts[1].verdicts[0].outcome = core::Outcome::kFail;
  EXPECT_TRUE(admit(rows.samples[0], rows).is_admitted);
}

TEST(Admission, AnInconclusiveVerdictIsSaid) {
  core::RunRows rows = proven();
  rows.verdicts[0].verdicts.push_back({.validator = "open-question", .outcome = core::Outcome::kInconclusive});
  const Admission admission = admit(rows.samples[0], rows);
  EXPECT_TRUE(admission.is_admitted);
  EXPECT_EQ(admission.caveat, "inconclusive: open-question");
}

TEST(Admission, NothingButNotApplicableProvesNothing) {
  core::RunRows rows = proven();
  rows.verdicts[0].verdicts[0].outcome = core::Outcome::kNotApplicable;
  expect_refused(rows, "nothing was proven");
  rows.verdicts.clear();
  expect_refused(rows, "nothing was proven");
}

// An engine that moves nothing breaks no other law in a scene in which nothing has to move.
TEST(Admission, AnEngineThatMovesBodiesHasToProveAMotion) {
  core::RunRows rows = proven();
  rows.verdicts[0].is_simulation = true;
  expect_refused(rows, "its motion was not proven (no law of motion was asked for)");
  core::Verdict ballistic{.validator = "ballistic",
                          .explanation = "no moving body was free of contact for a whole step"};
  ballistic.ties_motion_to_forces = true;
  rows.verdicts[0].verdicts.push_back(ballistic);
  expect_refused(rows, "proven (ballistic: no moving body was free of contact for a whole step)");
  core::Verdict& verdict = rows.verdicts[0].verdicts[1];
  verdict.outcome = core::Outcome::kPass;
  expect_refused(rows, "proven (ballistic: passed, but on no body that moved)");
  verdict.moved = 1;
  EXPECT_TRUE(admit(rows.samples[0], rows).is_admitted);
  // A law that does not tie motion to forces proves no motion, however often it was applied.
  verdict.ties_motion_to_forces = false;
  EXPECT_FALSE(admit(rows.samples[0], rows).is_admitted);
}

TEST(Admission, AnEngineThatIsFedHasNoMotionToProve) {
  core::RunRows rows = proven();
  rows.verdicts[0].is_simulation = false;
  EXPECT_TRUE(admit(rows.samples[0], rows).is_admitted);
}

TEST(Admission, AnotherAnswerIsStruckOutWithBothDigests) {
  core::RunRows rows = proven();
  rows.samples[0].final_digest = 43;
  expect_refused(rows,
                 "differs from the recording's at step 10 (digest 0x000000000000002b against 0x000000000000002a)");
}

TEST(Admission, AStepThatWasNotRecordedIsNoProof) {
  core::RunRows rows = proven();
  rows.samples[0].final_step = 11;
  expect_refused(rows, "keeps no digest of step 11");
}

TEST(Admission, TwoRecordingsThatDisagreeProveNothing) {
  core::RunRows rows = proven();
  rows.cells.push_back(rows.cells[0]);
  rows.cells[1].digests[10] = 43;
  expect_refused(rows, "differs from the recording's");
}

// 2 ms and 6 ms: median 4 ms; two frames in 8 ms are 250 frames per second.
TEST(Timing, FramesPerSecondAreFramesOverTheirTotalTime) {
  const std::vector<Timing> timings = pool_samples(proven());
  ASSERT_EQ(timings.size(), 1U);
  EXPECT_DOUBLE_EQ(timings[0].frame.median, 0.004);
  EXPECT_DOUBLE_EQ(timings[0].fps.mean, 250.0);
  ASSERT_EQ(timings[0].stages.size(), 1U);
  EXPECT_EQ(timings[0].stages[0].stage, "broad");
  EXPECT_DOUBLE_EQ(timings[0].stages[0].seconds.median, 0.002);
  EXPECT_TRUE(timings[0].admission.is_admitted);
  EXPECT_FALSE(timings[0].frame_is_sum);
}

TEST(Timing, WithoutAFrameSeriesTheStagesAreSummedAndThatIsSaid) {
  core::RunRows rows = proven();
  rows.samples[0].stages = {{"update", {0.001, 0.001}}, {"find", {0.002, 0.004}}};
  const std::vector<Timing> timings = pool_samples(rows);
  EXPECT_TRUE(timings[0].frame_is_sum);
  EXPECT_DOUBLE_EQ(timings[0].frame.median, 0.004);
}

TEST(Timing, OneWrongAnswerStrikesOutAllRunsOfItsStamp) {
  core::RunRows rows = proven();
  for (int k = 0; k < 4; ++k) rows.samples.push_back(rows.samples[0]);
  rows.samples[2].final_digest = 0;
  const std::vector<Timing> timings = pool_samples(rows);
  ASSERT_EQ(timings.size(), 1U);
  EXPECT_EQ(timings[0].repetitions, 5U);
  EXPECT_FALSE(timings[0].admission.is_admitted);
  EXPECT_NE(timings[0].admission.reason.find("(1 of 5 runs)"), std::string::npos) << timings[0].admission.reason;
}

}  // namespace
}  // namespace broadside::reports

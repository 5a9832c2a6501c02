#include "bench/contest/contest_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/contest/contest_document.hpp"
#include "bench/contest/known_causes.hpp"
#include "bench/contest/tunings.hpp"

namespace broadside::bench::contest {
namespace {

using core::Outcome;
using core::Verdict;

core::Stamp stamp(const std::string& scene, std::uint64_t digest) {
  core::Stamp s;
  s.scene_name = scene;
  s.scene_digest = digest;
  s.engine = "mine";
  s.engine_build = "Mine 1.0, double";
  return s;
}

Verdict verdict(const std::string& law, Outcome outcome, double measured = 0.0) {
  Verdict v;
  v.validator = law;
  v.outcome = outcome;
  v.measured = measured;
  v.unit = "m";
  v.kind = core::LawKind::kMechanics;
  v.explanation = law + " explained";
  return v;
}

// One scene at two steps: at its own step a law is broken, at half of it all laws hold. The timed run at the scene's
// own step ended in another digest.
core::RunRows rows() {
  core::RunRows rows;
  for (const bool is_own : {true, false}) {
    core::Cell cell;
    cell.stamp = stamp(is_own ? "rigid:a" : "rigid:a@1/120", is_own ? 1 : 2);
    cell.state = core::CellState::kRecorded;
    cell.trace_file = is_own ? "own.h5" : "half.h5";
    cell.digests = {{60, 7}};
    rows.cells.push_back(cell);
    core::CellVerdicts judged;
    judged.trace_file = cell.trace_file;
    judged.stamp = cell.stamp;
    judged.declaration = {{"friction", "cone"}};
    judged.verdicts = {verdict("closed-form", Outcome::kPass, is_own ? 0.2 : 0.1),
                       verdict("rest", is_own ? Outcome::kFail : Outcome::kPass, 1.0),
                       verdict("passage", Outcome::kNotApplicable)};
    rows.verdicts.push_back(judged);
    core::Sample sample;
    sample.stamp = cell.stamp;
    sample.stages = {{"frame", {0.001, 0.003, 0.002}}};
    sample.final_step = 60;
    sample.final_digest = is_own ? 8 : 7;
    rows.samples.push_back(sample);
  }
  return rows;
}

ContestTable table() {
  return contest_table(rows(), {{"mine", ""}, {"theirs", "not installed"}}, {{"rigid:a", 1.0 / 60}});
}

TEST(ContestTable, HasAnEntryForEachStep) {
  const ContestTable t = table();
  ASSERT_EQ(t.scenes.size(), 1U);
  EXPECT_EQ(t.scenes[0].steps, (std::vector<std::string>{"", "1/120"}));
  const Entry& own = t.scenes[0].entries.at("mine").at("");
  EXPECT_EQ(own.broken.size(), 1U);
  EXPECT_DOUBLE_EQ(own.error, 0.2);
  EXPECT_NEAR(own.cost, 0.002 * 60, 1e-12);
  EXPECT_TRUE(own.was_timed);
  EXPECT_FALSE(own.repeats);
  const Entry& half = t.scenes[0].entries.at("mine").at("1/120");
  EXPECT_TRUE(half.stands);
  EXPECT_TRUE(half.repeats);
  EXPECT_NEAR(half.cost, 0.002 * 120, 1e-12);
}

TEST(ContestTable, AnEngineThatHasCellsIsNotAbsentWhereItIsMissing) {
  const ContestTable elsewhere =
      contest_table(rows(), {{"mine", "not installed"}, {"theirs", "not installed"}}, {{"rigid:a", 1.0 / 60}});
  EXPECT_EQ(elsewhere.entrants[0].absent, "");
  EXPECT_EQ(elsewhere.entrants[1].absent, "not installed");
}

TEST(ContestTable, SaysWhatIsBrokenAndHowMuchApplied) {
  const ContestTable t = table();
  EXPECT_EQ(entry_text(t.scenes[0].entries.at("mine").at("")), "breaks rest; 2 of 3");
  EXPECT_EQ(entry_text(t.scenes[0].entries.at("mine").at("1/120")), "holds, 2 of 3");
  Entry crashed;
  crashed.state = core::CellState::kCrashed;
  crashed.reason = "signal 6";
  EXPECT_EQ(entry_text(crashed), "crashed: signal 6");
}

// What the page must say: an absent engine, the broken law with its worked line, the longest step that stands.
TEST(ContestTable, ThePageHasEveryPart) {
  const std::string page = html_text(contest_document(table(), "broadside contest"));
  for (const char* text : {"absent: not installed", "breaks rest; 2 of 3", "rest explained", ">1/120<",
                           "does not declare", "Mine 1.0, double", "Error against cost", "broadside contest"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
}

// A run with two threads is compared with that of one thread, and has no column of its own.
TEST(ContestTable, RunsOfOneAndTwoThreadsAreCompared) {
  const auto with = [](std::uint64_t of_one, std::uint64_t of_two) {
    core::RunRows all = rows();
    for (const auto& [threads, digest] : {std::pair("1", of_one), std::pair("2", of_two)}) {
      core::Cell cell;
      cell.stamp = stamp("rigid:a", 1);
      cell.stamp.settings_short = std::string("threads=") + threads;
      cell.state = core::CellState::kRecorded;
      cell.digests = {{60, digest}};
      all.cells.push_back(cell);
    }
    const ContestTable t = contest_table(all, {{"mine", ""}}, {{"rigid:a", 1.0 / 60}});
    EXPECT_EQ(t.scenes[0].entries.size(), 1U);
    return html_text(contest_document(t, "x"));
  };
  EXPECT_NE(with(7, 7).find("same digest on 1 of 1 scenes"), std::string::npos);
  EXPECT_NE(with(7, 8).find("same digest on 0 of 1 scenes"), std::string::npos);
  EXPECT_NE(html_text(contest_document(table(), "x")).find("one thread only"), std::string::npos);
}

// Depth, creep and cost have tables of their own; energy is a picture.
TEST(ContestTable, StacksHeapsAndEnergyAreOnThePage) {
  core::RunRows all = rows();
  all.verdicts[0].verdicts.push_back(verdict("penetration", Outcome::kPass, 0.002));
  for (auto& cell : all.cells) cell.stamp.scene_name = "freefall:cube:100" + cell.stamp.scene_name.substr(7);
  ContestTable t = contest_table(all, {{"mine", ""}}, {{"freefall:cube:100", 1.0 / 60}});
  t.scenes[0].energy["mine"] = {{0.0, 1.0, 2.0}, {0.0, 0.5, 50.0}};
  t.scenes[0].energy["other"] = {{0.0, 1.0, 2.0}, {0.0, 0.5, 0.5}};
  t.scenes[0].energy["third"] = {{0.0, 1.0, 2.0}, {0.0, 0.5, 1.0}};
  const std::string page = html_text(contest_document(t, "x"));
  for (const char* text : {"moves, 1 m; 2 mm deep", "2 ms a step; 2 mm deep",
                           "mine leaves the picture at 2 s with 50 J", "energy gained since the start, J"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
}

// A broken law has its cause beside it where the cause was looked into, and a note where it was not.
TEST(ContestTable, WhatIsBrokenHasItsCauseOrIsNotYetLookedInto) {
  core::RunRows all = rows();
  for (auto& cell : all.cells) cell.stamp.engine = "mujoco-world";
  for (auto& judged : all.verdicts) judged.stamp.engine = "mujoco-world";
  const auto page = [](const core::RunRows& r, const std::string& engine) {
    return html_text(contest_document(contest_table(r, {{engine, ""}}, {{"rigid:a", 1.0 / 60}}), "x"));
  };
  EXPECT_NE(page(all, "mujoco-world").find("rest: sticking bodies creep"), std::string::npos);
  EXPECT_NE(page(rows(), "mine").find("rest: not yet looked into"), std::string::npos);
  EXPECT_NE(page(rows(), "mine").find("Of the broken laws 0 were looked into"), std::string::npos);
  EXPECT_TRUE(known_cause("ode-world", "penetration", "rigid:billiards:cradle").empty());
  EXPECT_FALSE(known_cause("ode-world[solver=dantzig]", "penetration", "rigid:billiards:cradle").empty());
  EXPECT_TRUE(known_cause("plain-rigid", "momentum", "rigid:bounce").empty());
}

// `rest` is broken at the scene's own step, so it is not listed among laws that are broken at another step alone;
// `passage` is.
TEST(ContestTable, TellsWhatIsBrokenAtOtherStepsAlone) {
  core::RunRows all = rows();
  const auto page = [](const core::RunRows& r) {
    return html_text(contest_document(contest_table(r, {{"mine", ""}}, {{"rigid:a", 1.0 / 60}}), "x"));
  };
  EXPECT_EQ(page(all).find("and are broken at another"), std::string::npos);
  all.verdicts[1].verdicts[1].outcome = Outcome::kFail;
  EXPECT_EQ(page(all).find("and are broken at another"), std::string::npos);
  all.verdicts[1].verdicts[2] = verdict("passage", Outcome::kFail, 3.0);
  EXPECT_NE(page(all).find("1 laws hold at a scene"), std::string::npos);
  EXPECT_NE(page(all).find("in steps of 1/120 s"), std::string::npos);
  EXPECT_NE(page(all).find("0 of them not yet looked into"), std::string::npos);
  all.verdicts[1].verdicts[0].outcome = Outcome::kFail;
  EXPECT_NE(page(all).find("1 of them not yet looked into"), std::string::npos);
}

// Causes that hold at one step alone are looked up first; a cause without a step serves at every step.
TEST(ContestTable, OtherStepsHaveCausesOfTheirOwn) {
  EXPECT_FALSE(known_cause("cannon", "rest", "rigid:tip:push-stands@1/60").empty());
  EXPECT_TRUE(known_cause("cannon", "rest", "rigid:tip:push-stands").empty());
  EXPECT_TRUE(known_cause("cannon", "rest", "rigid:tip:push-stands@1/120").empty());
  EXPECT_NE(known_cause("mujoco3", "rest", "rigid:tip:push-stands@1/60"), known_cause("mujoco3", "rest", "rigid:tip:"));
  EXPECT_EQ(known_cause("jolt", "gyroscopic", "rigid:flight:box@1/60"), known_cause("jolt", "gyroscopic", "rigid:"));
}

// The engine that breaks a law is right on no scene; of the two timed runs one ended in another digest.
TEST(ContestTable, BeginsWithWhoIsRightAndWhoRepeats) {
  const std::string page =
      html_text(contest_document(contest_table(rows(), {{"mine", ""}}, {{"rigid:a", 1.0 / 60}}), "x"));
  EXPECT_NE(page.find("best setting: mine 0."), std::string::npos);
  EXPECT_NE(page.find("broken most often on a: in 1 of 1 rows."), std::string::npos);
  EXPECT_NE(page.find("of 2 timed runs ended in the same bits"), std::string::npos);
}

// Each engine has a row with its settings as shipped, and its recommended settings, if any, are a second entrant.
TEST(ContestTable, EveryTuningIsAnEntrant) {
  const auto entrants = default_entrants();
  for (const Tuning& t : tunings()) {
    EXPECT_NE(std::find(entrants.begin(), entrants.end(), t.as_shipped), entrants.end()) << t.as_shipped;
    if (!t.recommended.empty()) {
      EXPECT_NE(std::find(entrants.begin(), entrants.end(), t.recommended), entrants.end()) << t.recommended;
      EXPECT_TRUE(is_recommended(t.recommended));
    }
    EXPECT_FALSE(t.source.empty());
  }
  EXPECT_FALSE(is_recommended("ode-world"));
}

TEST(ContestTable, NothingRunIsAPageToo) {
  const std::string page = html_text(contest_document(contest_table({}, {{"mine", "not built"}}, {}), "x"));
  EXPECT_NE(page.find("mine is absent (not built)"), std::string::npos);
  EXPECT_EQ(page.find("Error against cost"), std::string::npos);
}

}  // namespace
}  // namespace broadside::bench::contest

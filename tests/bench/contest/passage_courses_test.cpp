#include "bench/contest/passage_courses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "bench/cell/scene_arguments.hpp"
#include "bench/contest/contest_document.hpp"
#include "bench/contest/contest_request.hpp"

namespace broadside::bench::contest {
namespace {

double magnitude(const core::Vec3& v) {
  return std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
}

// The largest speed of any body; for a needle that spins, the speed of its tip, which is 1 m from its middle.
double largest_speed_m_s(const core::Scene& scene) {
  double largest = 0.0;
  for (const core::Body& b : scene.bodies)
    largest = std::max({largest, magnitude(b.velocity), magnitude(b.angular_velocity)});
  return largest;
}

// The distances of the page are what the scenes' own bodies move in the scenes' own steps.
TEST(PassageCourses, DistancesAreSpeedTimesStep) {
  for (const PassageCourse& course : passage_courses())
    for (const PassageRun& run : course.runs) {
      const auto scene = SceneArguments{run.scene, 0, true}.make();
      ASSERT_TRUE(scene) << scene.error().line();
      // Steps are float32.
      EXPECT_NEAR(run.step_m, largest_speed_m_s(scene.value()) * static_cast<double>(scene.value().dt_s),
                  run.step_m * 1.2e-7)
          << run.scene;
    }
}

TEST(PassageCourses, AreCellsOfTheDefaultContestOnce) {
  ContestRequest request;
  request.engines = {"plain-rigid"};
  const auto campaign = contest_campaign(request);
  ASSERT_TRUE(campaign) << campaign.error().line();
  std::multiset<std::string> scenes;
  for (const auto& work : campaign.value().cells) scenes.insert(work.scene);
  for (const PassageCourse& course : passage_courses())
    for (const PassageRun& run : course.runs) EXPECT_EQ(scenes.count(run.scene), 1U) << run.scene;
}

// A mark in the picture shows the law's outcome, also for a scene that is about passage alone; such a scene is in no
// table of scenes with answers.
TEST(PassageCourses, ThePageSaysWhatWentThrough) {
  core::RunRows rows;
  const auto add = [&rows](const PassageRun& run, core::Outcome outcome) {
    core::Cell cell;
    cell.stamp.scene_name = run.scene;
    cell.stamp.engine = "mine";
    cell.state = core::CellState::kRecorded;
    cell.trace_file = run.scene + ".h5";
    core::CellVerdicts judged;
    judged.trace_file = cell.trace_file;
    core::Verdict v;
    v.validator = "passage";
    v.outcome = outcome;
    v.kind = core::LawKind::kMechanics;
    judged.verdicts = {v};
    rows.cells.push_back(cell);
    rows.verdicts.push_back(judged);
  };
  const auto courses = passage_courses();
  const PassageCourse& drop = courses.back();
  add(drop.runs[0], core::Outcome::kPass);
  add(drop.runs[1], core::Outcome::kFail);
  add(drop.runs[2], core::Outcome::kNotApplicable);
  const ContestTable table = contest_table(rows, {{"mine", ""}}, {{"rigid:a", 1.0 / 60}});
  EXPECT_TRUE(table.scenes.empty());
  Document document;
  add_passages(document, table);
  const auto words = std::find_if(document.blocks.begin(), document.blocks.end(),
                                  [](const Block& b) { return std::holds_alternative<Fold>(b); });
  ASSERT_NE(words, document.blocks.end());
  const auto& inside = std::get<Fold>(*words).blocks;
  ASSERT_EQ(inside.size(), 1U);
  const Table& lines = std::get<Table>(inside[0]);
  ASSERT_EQ(lines.rows.size(), drop.runs.size());
  EXPECT_EQ(lines.rows[0][2].text, "held");
  EXPECT_EQ(lines.rows[1][2].text, "through");
  EXPECT_EQ(lines.rows[2][2].text, "nothing met");
  EXPECT_EQ(lines.rows[3][2].text, "not run");
}

}  // namespace
}  // namespace broadside::bench::contest

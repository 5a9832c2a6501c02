// Coverage, proven motion, laws and declarations in the reports.
#include <gtest/gtest.h>

#include "reports/report.hpp"
#include "reports/terminal_table.hpp"
#include "tests/reports/markup_checker.hpp"

namespace broadside::reports {
namespace {

core::Verdict said(const char* law, core::LawKind kind, core::Outcome outcome) {
  core::Verdict v{.validator = law, .outcome = outcome, .unit = "m", .explanation = std::string(law) + " explained"};
  v.kind = kind;
  v.law = std::string("what ") + law + " says";
  v.checked = outcome == core::Outcome::kNotApplicable ? 0 : 10;
  return v;
}

// An engine that moves bodies, judged by three laws; the first ties motion to forces.
core::RunRows moving_rows(std::uint64_t moved) {
  core::RunRows rows;
  const core::Stamp stamp{.scene_name = "s", .scene_digest = 1, .engine = "e"};
  core::CellVerdicts judged{.trace_file = "e.h5", .stamp = stamp};
  judged.verdicts = {said("ballistic", core::LawKind::kMechanics, core::Outcome::kPass),
                     said("rest", core::LawKind::kMechanics, core::Outcome::kNotApplicable),
                     said("state-sanity", core::LawKind::kTrace, core::Outcome::kFail)};
  judged.verdicts[0].ties_motion_to_forces = true;
  judged.verdicts[0].moved = moved;
  core::Verdict part = said("finite", core::LawKind::kTrace, core::Outcome::kFail);
  part.violations = 3;
  part.worst = {.step = 9, .bodies = {5}, .field = "bodies.position"};
  judged.verdicts[2].parts = {part, said("domain", core::LawKind::kTrace, core::Outcome::kPass)};
  judged.is_simulation = true;
  judged.declaration = {{"contact_model", "compliant"}, {"own <key>", "value"}};
  rows.verdicts.push_back(judged);
  rows.cells.push_back({.stamp = stamp, .state = core::CellState::kRecorded, .trace_file = "e.h5", .frames = 10});
  return rows;
}

bool page_has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

constexpr const char* kCoverage = "1 of 2 laws of mechanics applied, 1 of 1 of the trace";
constexpr const char* kUnproven = "its motion was not proven";

TEST(CoverageReport, TheTerminalSaysHowManyLawsAppliedAndWhetherAMotionWasProven) {
  const std::string still = verdict_table(moving_rows(0).verdicts);
  EXPECT_TRUE(page_has(still, kCoverage)) << still;
  EXPECT_TRUE(page_has(still, kUnproven)) << still;
  EXPECT_FALSE(page_has(verdict_table(moving_rows(4).verdicts), kUnproven));
  core::RunRows two = moving_rows(0);
  two.verdicts.push_back(two.verdicts[0]);
  two.verdicts[1].stamp.engine = "f";
  EXPECT_TRUE(page_has(verdict_table(two.verdicts), std::string("[2] ") + kCoverage)) << verdict_table(two.verdicts);
}

TEST(CoverageReport, AnEngineThatWasFedHasNoMotionToProve) {
  core::RunRows rows = moving_rows(0);
  rows.verdicts[0].is_simulation = false;
  EXPECT_FALSE(page_has(verdict_table(rows.verdicts), kUnproven));
  EXPECT_FALSE(page_has(markdown_text(rows, {}), kUnproven));
}

TEST(CoverageReport, EachBrokenPartHasItsOwnLineAndPlace) {
  const std::string lines = failure_lines(moving_rows(4).verdicts);
  EXPECT_TRUE(page_has(lines, "e: state-sanity, finite: 3 of 10 FAIL")) << lines;
  EXPECT_TRUE(page_has(lines, "step 9, body 5")) << lines;
  EXPECT_FALSE(page_has(lines, "domain")) << lines;
  EXPECT_TRUE(page_has(junit_xml(moving_rows(4), {}), "finite: measured"));
}

TEST(CoverageReport, MarkdownAndJUnitSayItWithTheReasons) {
  const std::string text = markdown_text(moving_rows(0), {});
  EXPECT_TRUE(page_has(text, kCoverage)) << text;
  EXPECT_TRUE(page_has(text, kUnproven)) << text;
  EXPECT_TRUE(page_has(text, "rest: rest explained")) << text;
  EXPECT_TRUE(page_has(text, "not declared: taken as cone") || page_has(text, "| contact\\_model | compliant |"))
      << text;
  const std::string junit = junit_xml(moving_rows(0), {});
  EXPECT_TRUE(page_has(junit, std::string("name=\"coverage\" value=\"") + kCoverage)) << junit;
  EXPECT_TRUE(page_has(junit, "name=\"declaration.contact_model\" value=\"compliant\"")) << junit;
  EXPECT_EQ(testing_markup::check_markup(junit, false).problem, "");
}

TEST(CoverageReport, ThePageExplainsLawsWithPicturesAndShowsDeclarations) {
  if (!has_html_page()) GTEST_SKIP() << "built with BROADSIDE_REPORT_HTML=OFF";
  const std::string page = html_page(moving_rows(0), {});
  EXPECT_EQ(testing_markup::check_markup(page, true).problem, "");
  EXPECT_TRUE(page_has(page, "How much was judged"));
  EXPECT_TRUE(page_has(page, kUnproven));
  EXPECT_TRUE(page_has(page, "what ballistic says"));
  EXPECT_TRUE(page_has(page, "<svg class=\"sketch\""));
  EXPECT_TRUE(page_has(page, "proves motion"));
  EXPECT_TRUE(page_has(page, "not declared: taken as cone"));
  EXPECT_TRUE(page_has(page, "compliant"));
  EXPECT_TRUE(page_has(page, "own &lt;key&gt;"));
  EXPECT_TRUE(page_has(page, "3 of 10, worst at step 9, body 5"));
}

}  // namespace
}  // namespace broadside::reports

// Plain-text tables: within 100 columns, every verdict in words, no control characters for the terminal.
#include "reports/terminal_table.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "reports/escape.hpp"
#include "tests/reports/sample_rows.hpp"

namespace broadside::reports {
namespace {

using testing_rows::sample_rows;

void expect_fits(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(width(line), kTerminalColumns) << line;
    EXPECT_EQ(line.find('\x1B'), std::string::npos);
    EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
  }
  EXPECT_TRUE(text.ends_with("\n"));
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(TerminalTable, AMatrixFitsAndNamesEveryTraceAndValidator) {
  const core::RunRows rows = sample_rows();
  const std::string text = verdict_table(rows.verdicts);
  expect_fits(text);
  for (const std::string& validator : testing_rows::validator_names())
    EXPECT_NE(text.find(validator), std::string::npos) << validator;
  for (const core::CellVerdicts& cell : rows.verdicts)
    EXPECT_NE(text.find("] " + cell.stamp.label()), std::string::npos) << cell.stamp.label();
  EXPECT_EQ(count_of(text, "FAIL"), 2U);
  EXPECT_EQ(count_of(text, "unsure"), 1U);
}

TEST(TerminalTable, ManyTracesComeInBlocks) {
  core::RunRows rows = sample_rows();
  for (int k = 0; k < 30; ++k) {
    rows.verdicts.push_back(rows.verdicts[0]);
    rows.verdicts.back().stamp.settings += std::to_string(k);
    rows.verdicts.back().trace_file = std::to_string(k) + std::string(200, 'x');
  }
  const std::string text = verdict_table(rows.verdicts);
  expect_fits(text);
  EXPECT_NE(text.find("[40]"), std::string::npos);
}

TEST(TerminalTable, OneTraceShowsMeasuredValueLimitAndPlace) {
  const core::RunRows rows = sample_rows();
  const std::string text = verdict_table({rows.verdicts[5]});
  expect_fits(text);
  EXPECT_NE(text.find("FAIL"), std::string::npos);
  EXPECT_NE(text.find("0.0183 kg m"), std::string::npos);
  EXPECT_NE(text.find("step 412, bodies 3 and 17"), std::string::npos);
  EXPECT_NE(text.find("not a number"), std::string::npos);
}

TEST(TerminalTable, CellsSayTheirStateAndReason) {
  const std::string text = cell_table(sample_rows().cells);
  expect_fits(text);
  EXPECT_NE(text.find("not measured"), std::string::npos);
  EXPECT_NE(text.find("no device"), std::string::npos);
  EXPECT_NE(text.find("crashed"), std::string::npos);
  EXPECT_NE(text.find("signal 6 (abort)"), std::string::npos);
}

TEST(TerminalTable, AHostileNameMovesNoCursor) {
  core::RunRows rows = sample_rows();
  for (core::CellVerdicts& cell : rows.verdicts) cell.stamp.scene_name = cell.stamp.settings_short = "\x1B[2J\nx\x07";
  for (core::Cell& cell : rows.cells) cell.reason = "\x1B]0;title\x07\n" + std::string(500, 'r');
  expect_fits(verdict_table(rows.verdicts));
  expect_fits(cell_table(rows.cells));
  EXPECT_EQ(failure_lines(rows.verdicts).find('\x1B'), std::string::npos);
}

TEST(TerminalTable, NoRowsAreWordsNotABlank) {
  EXPECT_EQ(verdict_table({}), "no verdicts\n");
  EXPECT_EQ(cell_table({}), "no cells\n");
  EXPECT_EQ(failure_lines({}), "");
}

TEST(FailureLines, GiveOneLinePerFailedOrInconclusiveVerdict) {
  const std::string text = failure_lines(sample_rows().verdicts);
  EXPECT_EQ(count_of(text, "\n"), 3U);
  EXPECT_NE(text.find("octree-cpu[variant=printed-E3]: center-of-mass FAIL: measured 0.0183 kg m, limit "),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("step 412, bodies 3 and 17"), std::string::npos);
  EXPECT_NE(text.find("body 9 and face -y"), std::string::npos);
  EXPECT_NE(text.find("(limit: 8 ulp"), std::string::npos);
}

TEST(WarningLines, ShowWhatAPassedVerdictWarnsOf) {
  EXPECT_EQ(warning_lines(sample_rows().verdicts), "");
  core::CellVerdicts cell;
  cell.stamp.engine = "mine";
  core::Verdict passed;
  passed.validator = "turning";
  passed.outcome = core::Outcome::kPass;
  passed.explanation = "all 3 hold; warning: too far, use a smaller dt";
  cell.verdicts = {passed};
  EXPECT_EQ(warning_lines({cell}), "mine: turning: warning: too far, use a smaller dt\n");
  cell.verdicts[0].outcome = core::Outcome::kFail;
  EXPECT_EQ(warning_lines({cell}), "") << "its failure line says it";
}

}  // namespace
}  // namespace broadside::reports

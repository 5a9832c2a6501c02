// Rows survive writing and reading bit by bit, and malformed files are refused with a line that names the place.
#include "core/rows.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <limits>

#include "core/whole_file.hpp"

namespace broadside::core {
namespace {

namespace fs = std::filesystem;

class RowsTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("rows_test_" + std::to_string(getpid()) + "_" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

Stamp stamp() {
  return {.scene_name = "a \"scene\" \\ with </script> and \xC3\xA9",
          .scene_digest = 0xFEDCBA9876543210ULL,
          .engine = "octree-cpu",
          .settings = "levels=A,variant=sound",
          .settings_short = "levels=A",
          .engine_build = "own",
          .broadside_build = "0.1.0",
          .machine = "2 cores, no device"};
}

TEST_F(RowsTest, EveryFieldOfACellComesBack) {
  const Cell cell{.stamp = stamp(),
                  .state = CellState::kCrashed,
                  .reason = "signal 6 (abort) after frame 12",
                  .trace_file = "x.h5",
                  .frames = 12,
                  .wall_s = 0.1,
                  .digests = {{3000, 0xFFFFFFFFFFFFFFFFULL}, {7, 1}},
                  .notes = {{"mesh", "bunny.ply"}, {"", "empty key"}}};
  ASSERT_TRUE(write_cells(folder_ / "cells.json", {cell}).ok());
  const Result<RunRows> rows = read_rows(folder_);
  ASSERT_TRUE(rows.ok()) << rows.error().line();
  ASSERT_EQ(rows.value().cells.size(), 1U);
  const Cell& back = rows.value().cells[0];
  EXPECT_EQ(back.stamp.scene_name, cell.stamp.scene_name);
  EXPECT_EQ(back.stamp.scene_digest, cell.stamp.scene_digest);
  EXPECT_EQ(back.stamp.label(), "octree-cpu[levels=A]");
  EXPECT_EQ(back.stamp.settings, cell.stamp.settings);
  EXPECT_EQ(back.stamp.engine_build, "own");
  EXPECT_EQ(back.stamp.broadside_build, "0.1.0");
  EXPECT_EQ(back.stamp.machine, "2 cores, no device");
  EXPECT_EQ(back.state, CellState::kCrashed);
  EXPECT_EQ(back.reason, cell.reason);
  EXPECT_EQ(back.trace_file, "x.h5");
  EXPECT_EQ(back.frames, 12U);
  EXPECT_EQ(back.wall_s, 0.1);
  EXPECT_EQ(back.digests, cell.digests);
  EXPECT_EQ(back.notes, cell.notes);
}

TEST_F(RowsTest, EveryCellStateHasItsOwnWordThatReadsBack) {
  std::vector<Cell> cells;
  for (int k = 0; k <= static_cast<int>(CellState::kFailed); ++k) cells.push_back({.state = static_cast<CellState>(k)});
  ASSERT_TRUE(write_cells(folder_ / "cells.json", cells).ok());
  const Result<RunRows> rows = read_rows(folder_);
  ASSERT_TRUE(rows.ok()) << rows.error().line();
  ASSERT_EQ(rows.value().cells.size(), cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k) EXPECT_EQ(rows.value().cells[k].state, cells[k].state);
}

TEST_F(RowsTest, EveryFieldOfAVerdictComesBack) {
  const Verdict verdict{.validator = "contact-normal",
                        .outcome = Outcome::kFail,
                        .measured = std::numeric_limits<double>::quiet_NaN(),
                        .limit = -std::numeric_limits<double>::infinity(),
                        .unit = "rad",
                        .origin = "2 ulp",
                        .explanation = "flipped",
                        .worst = {.step = -1, .bodies = {3, 0xFFFFFFF2U}, .field = "contact.normal"},
                        .checked = 0xFFFFFFFFFFFFFFFFULL,
                        .violations = 7,
                        .baseline = "all-pairs"};
  const Verdict not_applicable{.validator = "x", .outcome = Outcome::kNotApplicable};
  ASSERT_TRUE(write_verdicts(folder_ / "verdicts.json", {{"x.h5", stamp(), {verdict, not_applicable}}}).ok());
  const Result<RunRows> rows = read_rows(folder_);
  ASSERT_TRUE(rows.ok()) << rows.error().line();
  ASSERT_EQ(rows.value().verdicts.size(), 1U);
  EXPECT_EQ(rows.value().verdicts[0].trace_file, "x.h5");
  ASSERT_EQ(rows.value().verdicts[0].verdicts.size(), 2U);
  const Verdict& back = rows.value().verdicts[0].verdicts[0];
  EXPECT_EQ(back.validator, "contact-normal");
  EXPECT_EQ(back.outcome, Outcome::kFail);
  EXPECT_TRUE(std::isnan(back.measured));
  EXPECT_EQ(back.limit, verdict.limit);
  EXPECT_EQ(back.unit, "rad");
  EXPECT_EQ(back.origin, "2 ulp");
  EXPECT_EQ(back.explanation, "flipped");
  EXPECT_EQ(back.worst.step, -1);
  EXPECT_EQ(back.worst.bodies, verdict.worst.bodies);
  EXPECT_EQ(back.worst.field, "contact.normal");
  EXPECT_EQ(back.checked, verdict.checked);
  EXPECT_EQ(back.violations, 7U);
  EXPECT_EQ(back.baseline, "all-pairs");
  EXPECT_EQ(rows.value().verdicts[0].verdicts[1].outcome, Outcome::kNotApplicable);
}

TEST_F(RowsTest, LawPartsAndDeclarationComeBack) {
  Verdict part{
      .validator = "integration", .outcome = Outcome::kFail, .worst = {.step = 9, .bodies = {5}, .field = "x"}};
  part.violations = 3;
  part.law = "each frame follows";
  Verdict verdict{.validator = "state-sanity", .outcome = Outcome::kFail};
  verdict.law = "states are possible";
  verdict.kind = LawKind::kMechanics;
  verdict.ties_motion_to_forces = true;
  verdict.moved = 12;
  verdict.parts = {part};
  CellVerdicts cell{.trace_file = "x.h5", .stamp = stamp(), .verdicts = {verdict}};
  cell.is_simulation = true;
  cell.declaration = {{"friction", "pyramid"}};
  ASSERT_TRUE(write_verdicts(folder_ / "verdicts.json", {cell}).ok());
  const Result<std::string> text = read_whole_file(folder_ / "verdicts.json");
  ASSERT_TRUE(text.ok());
  EXPECT_NE(text.value().find(R"("coverage":{"mechanics":{"applied":1,"laws":1})"), std::string::npos) << text.value();
  const Result<RunRows> rows = read_rows(folder_);
  ASSERT_TRUE(rows.ok()) << rows.error().line();
  const CellVerdicts& back = rows.value().verdicts[0];
  EXPECT_TRUE(back.is_simulation);
  EXPECT_EQ(back.declaration, cell.declaration);
  const Verdict& said = back.verdicts[0];
  EXPECT_EQ(said.law, verdict.law);
  EXPECT_EQ(said.kind, LawKind::kMechanics);
  EXPECT_TRUE(proves_motion(said) || said.outcome == Outcome::kFail);
  EXPECT_EQ(said.moved, 12U);
  ASSERT_EQ(said.parts.size(), 1U);
  EXPECT_EQ(said.parts[0].validator, "integration");
  EXPECT_EQ(said.parts[0].violations, 3U);
  EXPECT_EQ(said.parts[0].worst.step, 9);
  EXPECT_EQ(said.parts[0].law, part.law);
}

// Verdicts that builds wrote before laws had kinds and parts, and engines declarations.
TEST_F(RowsTest, VerdictsOfEarlierBuildsAreRead) {
  ASSERT_TRUE(write_verdicts(folder_ / "verdicts.json", {{"x.h5", stamp(), {{.validator = "v"}}}}).ok());
  std::string text = read_whole_file(folder_ / "verdicts.json").value();
  const auto cut = [&text](std::string_view from, std::string_view to) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.erase(at, text.find(to, at) - at);
  };
  cut(",\"law\":", "}");
  cut("\"is_simulation\":", "\"verdicts\":");
  ASSERT_TRUE(write_whole_file(folder_ / "verdicts.json", text).ok());
  const Result<RunRows> rows = read_rows(folder_);
  ASSERT_TRUE(rows.ok()) << rows.error().line() << text;
  EXPECT_EQ(rows.value().verdicts[0].verdicts[0].validator, "v");
  EXPECT_FALSE(rows.value().verdicts[0].is_simulation);
}

TEST_F(RowsTest, AKindThatIsNoneIsRefusedWithItsPlace) {
  ASSERT_TRUE(write_verdicts(folder_ / "verdicts.json", {{"x.h5", stamp(), {{.validator = "v"}}}}).ok());
  std::string text = read_whole_file(folder_ / "verdicts.json").value();
  const std::string word = "\"kind\":\"trace\"";
  const auto at = text.find(word);
  ASSERT_NE(at, std::string::npos) << text;
  text.replace(at, word.size(), "\"kind\":\"magic\"");
  ASSERT_TRUE(write_whole_file(folder_ / "verdicts.json", text).ok());
  const Result<RunRows> rows = read_rows(folder_);
  ASSERT_FALSE(rows.ok());
  EXPECT_NE(rows.error().line().find("kind"), std::string::npos) << rows.error().line();
}

TEST_F(RowsTest, SecondsOfASampleRoundTripBitByBit) {
  const std::vector<double> seconds{1.0 / 3.0, 5e-324,    1.7976931348623157e308,
                                    -0.0,      0.1 + 0.2, std::numeric_limits<double>::infinity()};
  const Sample sample{.stamp = stamp(),
                      .repetition = 4,
                      .warm_up_frames = 10,
                      .stages = {{"broad", seconds}, {"frame", {}}},
                      .final_digest = 0x8000000000000001ULL,
                      .final_step = 3000};
  ASSERT_TRUE(write_samples(folder_ / "samples.json", {sample}).ok());
  const Result<RunRows> rows = read_rows(folder_);
  ASSERT_TRUE(rows.ok()) << rows.error().line();
  ASSERT_EQ(rows.value().samples.size(), 1U);
  const Sample& back = rows.value().samples[0];
  EXPECT_EQ(back.repetition, 4U);
  EXPECT_EQ(back.warm_up_frames, 10U);
  EXPECT_EQ(back.final_digest, sample.final_digest);
  EXPECT_EQ(back.final_step, 3000U);
  ASSERT_EQ(back.stages.size(), 2U);
  EXPECT_EQ(back.stages[0].stage, "broad");
  EXPECT_EQ(back.stages[0].seconds, seconds);
  EXPECT_TRUE(std::signbit(back.stages[0].seconds[3]));
  EXPECT_TRUE(back.stages[1].seconds.empty());
}

TEST_F(RowsTest, AbsentFilesReadAsNoRows) {
  const Result<RunRows> rows = read_rows(folder_);
  ASSERT_TRUE(rows.ok());
  EXPECT_TRUE(rows.value().cells.empty() && rows.value().verdicts.empty() && rows.value().samples.empty());
}

TEST_F(RowsTest, AFolderThatIsNotThereIsBadInput) {
  const Result<RunRows> rows = read_rows(folder_ / "nowhere");
  ASSERT_FALSE(rows.ok());
  EXPECT_EQ(rows.error().exit, Exit::kBadInput);
  EXPECT_NE(rows.error().line().find("nowhere"), std::string::npos);
}

TEST_F(RowsTest, TextThatIsNotUtf8IsWrittenWithReplacementsRatherThanLost) {
  ASSERT_TRUE(write_cells(folder_ / "cells.json", {{.reason = "bad \xFF byte"}}).ok());
  const Result<RunRows> rows = read_rows(folder_);
  ASSERT_TRUE(rows.ok()) << rows.error().line();
  EXPECT_EQ(rows.value().cells[0].reason, "bad \xEF\xBF\xBD byte");
}

TEST_F(RowsTest, RewritingLeavesNoPartFileAndOnlyTheNewContent) {
  ASSERT_TRUE(write_cells(folder_ / "cells.json", std::vector<Cell>(100)).ok());
  ASSERT_TRUE(write_cells(folder_ / "cells.json", {}).ok());
  EXPECT_FALSE(fs::exists(folder_ / "cells.json.part"));
  const Result<RunRows> rows = read_rows(folder_);
  ASSERT_TRUE(rows.ok()) << rows.error().line();
  EXPECT_TRUE(rows.value().cells.empty());
}

TEST_F(RowsTest, AFolderThatIsMissingOrAFileInItsPlaceIsOneClearLine) {
  const Status missing = write_cells(folder_ / "no" / "cells.json", {});
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().line().find("cells.json"), std::string::npos);
  EXPECT_EQ(missing.error().line().find('\n'), std::string::npos);
  fs::create_directories(folder_ / "cells.json" / "full");
  const Status occupied = write_cells(folder_ / "cells.json", {});
  EXPECT_FALSE(occupied.ok());
  EXPECT_FALSE(fs::exists(folder_ / "cells.json.part"));
}

// Linux's device that is always full: every write() fails, so the error path of a full disk runs.
TEST_F(RowsTest, AFullDiskIsReportedAndNothingStaysUnderTheFinalName) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full on this system";
  fs::create_symlink("/dev/full", folder_ / "cells.json.part");
  const Status status = write_cells(folder_ / "cells.json", {});
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().line().find("No space left"), std::string::npos) << status.error().line();
  EXPECT_FALSE(fs::exists(folder_ / "cells.json"));
}

struct BadFile {
  const char* name;
  const char* content;
  const char* expected;  // a part of the error line
};

class BadRowsTest : public testing::TestWithParam<BadFile> {};

TEST_P(BadRowsTest, IsRefusedWithThePlaceNamed) {
  const fs::path folder = fs::temp_directory_path() / ("bad_rows_" + std::to_string(getpid()) + GetParam().name);
  fs::create_directories(folder);
  ASSERT_TRUE(write_whole_file(folder / "cells.json", GetParam().content).ok());
  const Result<RunRows> rows = read_rows(folder);
  fs::remove_all(folder);
  ASSERT_FALSE(rows.ok());
  const std::string line = rows.error().line();
  EXPECT_NE(line.find(GetParam().expected), std::string::npos) << line;
  EXPECT_NE(line.find("cells.json"), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  EXPECT_EQ(rows.error().exit, Exit::kBadInput);
}

constexpr char kStamp[] =
    R"("stamp":{"scene_name":"s","scene_digest":"0x0000000000000001","engine":"e","settings":"","settings_short":"",)"
    R"("engine_build":"","broadside_build":"","machine":""})";

std::string cell_with(const std::string& fields) {
  return std::string(R"({"format":"broadside-cells","version":1,"rows":[{)") + kStamp + "," + fields + "}]}";
}

TEST(BadRows, ACellWithAnUnknownStateIsRefusedWithTheKnownOnes) {
  const fs::path folder = fs::temp_directory_path() / ("bad_state_" + std::to_string(getpid()));
  fs::create_directories(folder);
  ASSERT_TRUE(write_whole_file(folder / "cells.json", cell_with(R"("state":"fine")")).ok());
  const Result<RunRows> rows = read_rows(folder);
  fs::remove_all(folder);
  ASSERT_FALSE(rows.ok());
  EXPECT_NE(rows.error().line().find("rows[0].state: is 'fine', not one of 'recorded'"), std::string::npos)
      << rows.error().line();
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, BadRowsTest,
    testing::Values(
        BadFile{"empty", "", "is not JSON"}, BadFile{"truncated", "{\"format\": \"broadside-c", "is not JSON"},
        BadFile{"array", "[]", "is not an object"},
        BadFile{"format", R"({"format":"broadside-samples","version":1,"rows":[]})", "broadside-cells"},
        BadFile{"version", R"({"format":"broadside-cells","version":2,"rows":[]})", "version"},
        BadFile{"rows", R"({"format":"broadside-cells","version":1,"rows":{}})", "rows: is not an array"},
        BadFile{"field", R"({"format":"broadside-cells","version":1,"rows":[{}]})", "lacks 'stamp'"},
        BadFile{"digest",
                R"({"format":"broadside-cells","version":1,"rows":[{"stamp":{"scene_name":"","scene_digest":"12"}}]})",
                "rows[0].stamp.scene_digest"}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace broadside::core

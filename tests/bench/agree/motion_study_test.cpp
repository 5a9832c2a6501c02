// The motion study's parts: verdicts on planted answers, families that have the property they are named for, and query
// files.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bench/agree/motion/body_draw.hpp"
#include "bench/agree/motion/feature_draw.hpp"
#include "bench/agree/motion/motion_verdicts.hpp"
#include "bench/agree/motion/query_file.hpp"
#include "core/continuous/feature_impact.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::bench {
namespace {

using tests::ScratchFolder;

MotionAnswer says(bool touches, double time) {
  MotionAnswer answer;
  answer.asked = Asked::kAnswered;
  answer.found = {touches, time};
  return answer;
}

TEST(MotionVerdicts, EveryFaultHasItsName) {
  MotionTest touch;
  touch.truth = {MotionTruth::Kind::kTouch, 0.5, 0.5 + 0x1p-53, false};
  const auto verdict = [](const MotionTest& test, const MotionAnswer& answer) {
    return judge(test, answer, 0.0, 1e-6);
  };
  EXPECT_EQ(verdict(touch, says(true, 0.5)), MotionVerdict::kAgree);
  EXPECT_EQ(verdict(touch, says(true, 0.4999999)), MotionVerdict::kAgree);
  EXPECT_EQ(verdict(touch, says(true, 0.499)), MotionVerdict::kEarly);
  EXPECT_EQ(verdict(touch, says(true, std::nextafter(0.5 + 0x1p-53, 1.0))), MotionVerdict::kLate);
  EXPECT_EQ(verdict(touch, says(false, 1.0)), MotionVerdict::kMissed);
  EXPECT_EQ(verdict(touch, says(true, std::nan(""))), MotionVerdict::kNoNumber);
  EXPECT_EQ(verdict(touch, says(true, 1.5)), MotionVerdict::kNoNumber);
  EXPECT_EQ(judge(touch, says(true, 0.5001), 1e-3, 1e-3), MotionVerdict::kAgree) << "within the band of bodies";
  MotionAnswer dead;
  dead.asked = Asked::kAborted;
  EXPECT_EQ(verdict(touch, dead), MotionVerdict::kAborted);
  MotionAnswer other = says(true, 0.1);
  other.follows = false;
  EXPECT_EQ(verdict(touch, other), MotionVerdict::kOtherPath);
  touch.truth.rounding_decides = true;
  EXPECT_EQ(verdict(touch, says(false, 1.0)), MotionVerdict::kRounded);
  const MotionTest apart;
  EXPECT_EQ(verdict(apart, says(false, 1.0)), MotionVerdict::kAgree);
  EXPECT_EQ(verdict(apart, says(true, 0.3)), MotionVerdict::kFalse);
}

TEST(MotionVerdicts, SumsByFamily) {
  std::vector<MotionTest> tests(3);
  for (MotionTest& test : tests) test.truth = {MotionTruth::Kind::kTouch, 0.5, 0.5, false};
  tests[2].family = 3;
  const MotionTable table =
      tabulate(MotionKind::kEdgeEdge, tests, {says(true, 0.25), says(false, 1.0), says(true, 0.75)}, {});
  EXPECT_EQ(table.by_family[0].touches(), 2U);
  EXPECT_EQ(table.by_family[0].of(MotionVerdict::kMissed), 1U);
  EXPECT_EQ(table.by_family[3].of(MotionVerdict::kLate), 1U);
  EXPECT_EQ(table.all.tests(), 3U);
  EXPECT_EQ(median_of(table.all.early), 0.25);
  EXPECT_EQ(median_of(table.all.late), 0.25);
}

// A family in which nothing touches, or in which everything touches at once, says nothing about an engine.
TEST(FeatureDraw, FamiliesTouchAndDoNot) {
  for (const MotionKind kind : {MotionKind::kVertexFace, MotionKind::kEdgeEdge}) {
    std::array<int, std::size(kFeatureFamilies)> touching{}, drawn{};
    int decided_by_rounding = 0;
    for (std::uint64_t index = 0; index < 6000; ++index) {
      const DrawnFeatures query = draw_features(kind, 7, index);
      const auto test = to_test(query.query, query.family);
      ASSERT_TRUE(test.ok());
      const MotionTruth& truth = test.value().truth;
      ++drawn[query.family];
      touching[query.family] += truth.kind == MotionTruth::Kind::kTouch ? 1 : 0;
      decided_by_rounding += truth.rounding_decides ? 1 : 0;
      if (query.family == 4) {
        EXPECT_EQ(truth.upper, 0.0) << "touching at the start, query " << index;
      }
    }
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      EXPECT_GT(drawn[k], 300) << kFeatureFamilies[k];
      EXPECT_GT(touching[k], 5) << kFeatureFamilies[k];
      if (k != 4) {
        EXPECT_GT(drawn[k] - touching[k], 10) << kFeatureFamilies[k];
      }
    }
    EXPECT_GT(decided_by_rounding, 0) << "fractions are there to be rounded";
  }
}

TEST(FeatureDraw, OurOwnMissesNothingAndIsNeverLate) {
  for (const MotionKind kind : {MotionKind::kVertexFace, MotionKind::kEdgeEdge}) {
    std::vector<MotionTest> tests;
    std::vector<MotionAnswer> answers;
    for (std::uint64_t index = 0; index < 6000; ++index) {
      const DrawnFeatures query = draw_features(kind, 8, index);
      tests.push_back(to_test(query.query, query.family).value());
      const continuous::Impact found = continuous::first_impact(tests.back().features);
      answers.push_back(says(found.touches, found.time));
    }
    const MotionTable table = tabulate(kind, tests, answers, {});
    EXPECT_EQ(table.all.of(MotionVerdict::kMissed), 0U);
    EXPECT_TRUE(table.all.late.empty());
    EXPECT_LT(median_of(table.all.early), 1e-6);
    EXPECT_EQ(table.by_family[0].of(MotionVerdict::kFalse), 0U);
  }
}

TEST(BodyDraw, FamiliesAreWhatTheySay) {
  const auto source = BodySource::make(MotionKind::kCapsules, 3, "");
  ASSERT_TRUE(source.ok());
  std::array<int, std::size(kBodyFamilies)> touching{}, apart{};
  for (std::uint64_t index = 0; index < 320; ++index) {
    const MotionTest test = source.value().test(index);
    const std::string_view family = kBodyFamilies[test.family];
    const bool turns = length(test.a.motion.rotation_rad) > 0.0 || length(test.b.motion.rotation_rad) > 0.0;
    const bool moves = length(test.a.motion.displacement_m) > 0.0 || length(test.b.motion.displacement_m) > 0.0;
    EXPECT_EQ(turns, family == "turning" || family == "turning in place" || (family == "thin" && turns));
    EXPECT_EQ(moves, family != "turning in place" && family != "standstill");
    EXPECT_LE(test.truth.lower, test.truth.upper);
    touching[test.family] += test.truth.kind == MotionTruth::Kind::kTouch ? 1 : 0;
    apart[test.family] += test.truth.kind == MotionTruth::Kind::kApart ? 1 : 0;
    const MotionTest again = source.value().test(index);
    EXPECT_EQ(again.truth.lower, test.truth.lower) << "a test follows from its index";
  }
  for (std::size_t k = 0; k < touching.size(); ++k) {
    EXPECT_GT(touching[k], 3) << kBodyFamilies[k];
    if (kBodyFamilies[k] != "fast") {
      EXPECT_GT(apart[k], 0) << kBodyFamilies[k];
    }
  }
}

constexpr std::string_view kTouchingQuery =
    "1,4,1,4,1,1,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n"
    "1,4,1,4,-2,1,1\n0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n";

core::Result<std::vector<FileQuery>> read_back(const std::string& text) {
  const ScratchFolder folder;
  std::ofstream(folder / "q.csv") << text;
  return read_query_file(folder / "q.csv", continuous::FeatureKind::kVertexFace);
}

TEST(QueryFile, IsReadAndWrittenAsItIs) {
  const std::string text = std::string(kTouchingQuery) + std::string(kTouchingQuery);
  const auto queries = read_back(text);
  ASSERT_TRUE(queries.ok()) << queries.error().line();
  ASSERT_EQ(queries.value().size(), 2U);
  EXPECT_TRUE(queries.value()[1].touches);
  const auto found = exact::first_touch(queries.value()[1].features);
  ASSERT_TRUE(found.ok());
  EXPECT_NEAR(found.value().lower, 1.0 / 3.0, 1e-15);
  const ScratchFolder folder;
  ASSERT_TRUE(write_query_file(queries.value(), folder / "q.csv").ok());
  EXPECT_EQ(tests::read_text(folder / "q.csv"), text);
}

TEST(QueryFile, BadFilesAreOneLineWithThePlace) {
  const std::string good(kTouchingQuery);
  const std::string row = "1,4,1,4,1,1,1\n";
  for (const auto& [text, place, what] :
       std::vector<std::array<std::string, 3>>{{"", "line 0", "no query"},
                                               {good + row, "line 9", "1 rows, not 8"},
                                               {good + "1,4,1,4,1,1\n", "line 9", "6 columns"},
                                               {good + "1,4,1,4,1,0,1\n", "line 9", "denominator '0'"},
                                               {good + "1,4,x,4,1,1,1\n", "line 9", "'x' is no integer"},
                                               {good + "1.5,4,1,4,1,1,1\n", "line 9", "'1.5' is no integer"},
                                               {good + "1,4,1,4,1,1,2\n", "line 9", "not 0 or 1"},
                                               {row + "1,4,1,4,1,1,0\n", "line 2", "name different truths"}}) {
    const auto read = read_back(text);
    ASSERT_FALSE(read.ok()) << text;
    const std::string line = read.error().line();
    EXPECT_NE(line.find(place), std::string::npos) << line;
    EXPECT_NE(line.find(what), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_EQ(read.error().exit, core::Exit::kBadInput);
  }
}

}  // namespace
}  // namespace broadside::bench

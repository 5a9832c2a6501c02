#include <gtest/gtest.h>

#include "bench/contest/contest_document.hpp"
#include "bench/contest/families.hpp"

namespace broadside::bench::contest {
namespace {

core::Verdict verdict(const std::string& law, core::Outcome outcome, double measured, double limit) {
  core::Verdict v;
  v.validator = law;
  v.outcome = outcome;
  v.measured = measured;
  v.limit = limit;
  v.unit = "m";
  v.kind = core::LawKind::kMechanics;
  v.explanation = law + " explained";
  return v;
}

// Two scenes of one family and one of another; an engine whose broken laws have causes, one whose have none, and one
// that is not here.
ContestTable two_engine_table() {
  core::RunRows rows;
  for (const char* scene : {"rigid:slide:heading-1", "rigid:bounce", "rigid:slide:heading-2"})
    for (const char* engine : {"mujoco-world", "mine"}) {
      core::Cell cell;
      cell.stamp.scene_name = scene;
      cell.stamp.engine = engine;
      cell.state = core::CellState::kRecorded;
      cell.trace_file = std::string(scene) + engine;
      rows.cells.push_back(cell);
      core::CellVerdicts judged;
      judged.trace_file = cell.trace_file;
      const bool is_broken = std::string(scene) == "rigid:slide:heading-1";
      judged.verdicts = {verdict("closed-form", is_broken ? core::Outcome::kFail : core::Outcome::kPass, 0.4, 0.1),
                         verdict("rest", is_broken ? core::Outcome::kFail : core::Outcome::kPass, 2.0, 0.1),
                         verdict("momentum", core::Outcome::kPass, 0.5, 1.0),
                         verdict("turning", core::Outcome::kPass, 0.1, 1.0)};
      rows.verdicts.push_back(judged);
    }
  const double own = 1.0 / 240;
  return contest_table(rows, {{"mujoco-world", ""}, {"mine", ""}, {"theirs", "not installed"}},
                       {{"rigid:slide:heading-1", own}, {"rigid:slide:heading-2", own}, {"rigid:bounce", own}});
}

const Mosaic& mosaic_of(const Document& document) {
  for (const Block& block : document.blocks)
    if (const auto* mosaic = std::get_if<Mosaic>(&block)) return *mosaic;
  throw std::runtime_error("no mosaic");
}

TEST(ContestOverview, ScenesOfAFamilyStandSideBySide) {
  const ContestTable t = two_engine_table();
  const auto families = families_of(t);
  ASSERT_EQ(families.size(), 2U);
  EXPECT_EQ(families[0].name, "slide");
  EXPECT_EQ(families[0].scenes.size(), 2U);
  EXPECT_EQ(short_name("freefall:cube:100[rigid=1,frames=240]"), "freefall:cube:100");
  const Document document = contest_document(t, "x");
  const Mosaic& mosaic = mosaic_of(document);
  ASSERT_EQ(mosaic.columns.size(), 3U);
  EXPECT_EQ(mosaic.columns[1].name, "slide:heading-2");
  EXPECT_FALSE(mosaic.columns[1].starts_group);
  EXPECT_TRUE(mosaic.columns[2].starts_group);
}

// A square says how many laws are broken where all causes are known, "?" where one is not, and what was worst.
TEST(ContestOverview, ASquareSaysWhatIsWorst) {
  const Document document = contest_document(two_engine_table(), "x");
  const Mosaic& mosaic = mosaic_of(document);
  const Square& known = mosaic.rows[0].squares[0];
  EXPECT_EQ(known.mark, "2");
  EXPECT_FALSE(known.is_open);
  EXPECT_NE(known.words.find("furthest from its limit is rest: 2 m, limit 0.1 m"), std::string::npos) << known.words;
  const Square& unknown = mosaic.rows[1].squares[0];
  EXPECT_EQ(unknown.mark, "?");
  EXPECT_TRUE(unknown.is_open);
  EXPECT_NE(unknown.words.find("not yet looked into"), std::string::npos) << unknown.words;
  // Some laws hold while they are above their limit, which is then a least value; they are never named as near to their
  // limit.
  EXPECT_NE(mosaic.rows[0].squares[1].words.find("nearest to its limit is momentum: 0.5 m, limit 1 m"),
            std::string::npos);
  EXPECT_EQ(mosaic.rows[2].squares[0].tone, Tone::kAbsent);
  EXPECT_NE(mosaic.rows[2].squares[0].words.find("absent: not installed"), std::string::npos);
}

TEST(ContestOverview, EverySquareThatLeadsSomewhereHasItsLine) {
  const Document document = contest_document(two_engine_table(), "x");
  const std::string page = html_text(document);
  for (const MosaicRow& row : mosaic_of(document).rows)
    for (const Square& square : row.squares)
      if (!square.target.empty()) {
        EXPECT_NE(page.find("<li id=\"" + square.target + "\">"), std::string::npos) << square.target;
      }
  EXPECT_NE(page.find("id=\"family_slide\""), std::string::npos);
}

// One line for each cause; broken laws whose cause was not looked into come first.
TEST(ContestOverview, CausesAreCounted) {
  const std::string page = html_text(contest_document(two_engine_table(), "x"));
  EXPECT_NE(page.find("Of the broken laws 2 were looked into"), std::string::npos);
  EXPECT_NE(page.find("The other 2 are not yet looked into"), std::string::npos);
  EXPECT_LT(page.find("not yet looked into</th>"), page.find("sticking bodies creep"));
}

TEST(ContestOverview, MarkdownHasALineOfMarksAnEngine) {
  const std::string text = markdown_text(contest_document(two_engine_table(), "x"));
  EXPECT_NE(text.find("mujoco-world  2. ."), std::string::npos) << text;
  EXPECT_NE(text.find("mine          ?. ."), std::string::npos);
}

}  // namespace
}  // namespace broadside::bench::contest

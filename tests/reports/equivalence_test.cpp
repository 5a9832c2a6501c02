// Equivalence cards, known defects and agreement: from notes to the page and the comment.
#include "reports/equivalence.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "reports/report.hpp"
#include "tests/reports/markup_checker.hpp"
#include "tests/reports/sample_rows.hpp"

namespace broadside::reports {
namespace {

core::RunRows rows_with_notes() {
  core::RunRows rows;
  for (const std::string engine : {"bullet-world", "octree-cpu"}) {
    core::Cell cell;
    cell.stamp = testing_rows::stamp_of(engine, "");
    cell.state = core::CellState::kRecorded;
    cell.frames = 3;
    rows.cells.push_back(cell);
  }
  auto& bullet = rows.cells[0].notes;
  core::add_notes(core::EquivalenceCard{{"friction rule", "product", "geometric mean"}, {"sleeping", "off", ""}},
                  bullet);
  core::add_notes({core::DefectHits{"Bullet 3.24", "none known", "a pair <that> does not overlap", 7, 20}}, bullet);
  bullet["agreement: s0 deep"] = "12 agree, 3 depth off; median 2 us";
  bullet["agreement: t1 thin plate"] = "5 agree";
  rows.cells[1].notes["agreement: s0 deep"] = "15 agree";
  return rows;
}

TEST(Equivalence, NotesBringBackWhatWasWritten) {
  std::map<std::string, std::string> notes;
  core::add_notes(core::EquivalenceCard{{"margin", "0.04 m", "none"}}, notes);
  core::add_notes({core::DefectHits{"FCL 0.7.0", "fcl#491", "no depth", 3, 9}}, notes);
  ASSERT_EQ(notes.size(), 2U);
  int facts = 0;
  int defects = 0;
  for (const auto& [key, text] : notes) {
    EXPECT_TRUE(is_equivalence_note(key)) << key;
    if (const auto fact = core::equivalence_of_note(key, text)) {
      ++facts;
      EXPECT_EQ(fact->property, "margin");
      EXPECT_EQ(fact->engine, "0.04 m");
      EXPECT_EQ(fact->scene, "none");
    }
    if (const auto defect = core::defect_of_note(key, text)) {
      ++defects;
      EXPECT_EQ(defect->upstream, "fcl#491");
      EXPECT_EQ(defect->predicate, "no depth");
      EXPECT_EQ(defect->hits, 3U);
      EXPECT_EQ(defect->asked, 9U);
    }
  }
  EXPECT_EQ(facts, 1);
  EXPECT_EQ(defects, 1);
  EXPECT_FALSE(is_equivalence_note("mesh bunny"));
  EXPECT_FALSE(core::defect_of_note("vendor defect: half a key", "3 of 9").has_value());
  EXPECT_FALSE(core::defect_of_note("vendor defect: a | b | c", "many").has_value());
}

TEST(Equivalence, PageMarksDifferencesAndCountsThem) {
  const core::RunRows rows = rows_with_notes();
  const std::vector<SceneView> scenes = by_scene(rows);
  const std::string section = equivalence_section(scenes.at(0));
  EXPECT_NE(section.find("1 difference from the scene"), std::string::npos) << section;
  EXPECT_NE(section.find("differs:</strong> geometric mean"), std::string::npos);
  EXPECT_NE(section.find("7 of 20"), std::string::npos);
  EXPECT_NE(section.find("&lt;that&gt;"), std::string::npos) << "escaped";
  EXPECT_NE(section.find("12 agree, 3 depth off"), std::string::npos);
  const std::string page = html_page(rows, {});
  EXPECT_NE(page.find(section), std::string::npos);
  EXPECT_EQ(page.find("equivalence: friction rule"), std::string::npos) << "nowhere else";
  EXPECT_EQ(testing_markup::check_markup(page, true).problem, "");
}

TEST(Equivalence, CommentShowsDifferencesAlone) {
  const core::RunRows rows = rows_with_notes();
  const std::string text = markdown_text(rows, {});
  EXPECT_NE(text.find("friction rule"), std::string::npos);
  EXPECT_EQ(text.find("sleeping"), std::string::npos) << "the same as the scene";
  EXPECT_NE(text.find("7 of 20"), std::string::npos);
  EXPECT_NE(text.find("thin plate"), std::string::npos);
}

TEST(Equivalence, ScenesWithoutNotesHaveNoSection) {
  core::RunRows rows = rows_with_notes();
  for (core::Cell& cell : rows.cells) cell.notes.clear();
  EXPECT_EQ(equivalence_section(by_scene(rows).at(0)), "");
  EXPECT_TRUE(equivalence_markdown(by_scene(rows).at(0)).empty());
}

}  // namespace
}  // namespace broadside::reports

// Equivalence cards, known defects and agreement: from notes to the page and the comment.
#include "reports/equivalence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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
  bullet["agreement histogram: distance, m, from -8"] = "3 0 0 12";
  rows.cells[1].notes["agreement histogram: distance, m, from -8"] = "15 0 0 0";
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
  const std::string page = html_page(rows, {});
  EXPECT_NE(page.find(section), std::string::npos);
  EXPECT_EQ(page.find("equivalence: friction rule"), std::string::npos) << "nowhere else";
  EXPECT_EQ(testing_markup::check_markup(page, true).problem, "");
}

// Bin 0 is below 10^-8 m; the last of four is 10^-6 m or more.
TEST(Equivalence, AgreementIsATableAndHistogramsWithTheirTable) {
  const core::RunRows rows = rows_with_notes();
  const auto histograms = agreement_histograms_of(by_scene(rows).at(0));
  ASSERT_EQ(histograms.size(), 1U) << "nothing speaks of normals";
  EXPECT_EQ(histograms[0].second.lowest_power, -8);
  ASSERT_EQ(histograms[0].second.rows.size(), 2U);
  EXPECT_EQ(histograms[0].second.rows[0].second, (std::vector<double>{3, 0, 0, 12}));
  const std::string page = html_page(rows, {});
  EXPECT_NE(page.find("12 agree, 3 depth off"), std::string::npos);
  const auto charts = page_charts(rows, {});
  const auto chart = std::find_if(charts.begin(), charts.end(),
                                  [](const Chart& c) { return c.title == "Distance and depth, off by"; });
  ASSERT_NE(chart, charts.end());
  EXPECT_EQ(chart->y.categories, (std::vector<std::string>{"below 1e-8", "below 1e-7", "below 1e-6", "1e-6 or more"}));
  ASSERT_EQ(chart->series.size(), 2U);
  EXPECT_EQ(chart->series[0].x, (std::vector<double>{20, 0, 0, 80})) << "percent of its answers";
  EXPECT_NE(chart_table(*chart).find("below 1e-8"), std::string::npos);
  EXPECT_EQ(page.find("3 0 0 12"), std::string::npos) << "the note itself is printed nowhere";
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

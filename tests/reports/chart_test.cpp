// Charts as data for the page, as tables, as CSV and as pictures; names from outside stay text in all of them.
#include "reports/chart.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "reports/chart_svg.hpp"

namespace broadside::reports {
namespace {

constexpr const char* kHostile = "</script><script>alert(1)</script>";

Chart sample() {
  Chart chart{.title = kHostile,
              .description = "two lines",
              .x = {.name = "frame"},
              .y = {.name = "FPS", .unit = "1/s", .is_log = true}};
  chart.series.push_back(
      {.name = "a, b", .x = {1, 2, 3}, .y = {10, 20.123456, 30}, .low = {9, 19, 29}, .high = {11, 21, 31}});
  chart.series.push_back({.name = kHostile, .x = {2, 4}, .y = {std::numeric_limits<double>::quiet_NaN(), 5}});
  return chart;
}

TEST(Chart, JsonCannotEndItsElementAndReadsBack) {
  ChartBook book;
  EXPECT_NE(book.figure(sample()), "");
  const std::string json = book.json();
  EXPECT_EQ(json.find('<'), std::string::npos);
  EXPECT_EQ(json.find('>'), std::string::npos);
  const auto read = nlohmann::json::parse(json);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0]["title"], kHostile);
  EXPECT_EQ(read[0]["series"][0]["y"][1], 20.12) << "four digits";
  EXPECT_TRUE(read[0]["series"][1]["y"][0].is_null()) << "no number is no zero";
  EXPECT_TRUE(read[0]["y"]["log"]);
  EXPECT_FALSE(read[0]["x"].contains("log"));
}

TEST(Chart, TheTableHasARowForEachPlaceAndAWordForEachGap) {
  const std::string table = chart_table(sample());
  EXPECT_EQ(table.find("<script"), std::string::npos);
  for (const char* part :
       {"<th scope=\"row\">1</th>", "<th scope=\"row\">4</th>", "10 [9, 11]", "none", "not a number", "FPS in 1/s"})
    EXPECT_NE(table.find(part), std::string::npos) << part << "\n" << table;
}

TEST(Chart, LongSeriesAreThinnedInTheTableAndItSaysSo) {
  Chart chart{.title = "t", .x = {.name = "step"}, .y = {.name = "v"}};
  Series s{.name = "s"};
  for (int k = 0; k < 400; ++k) s.x.push_back(k), s.y.push_back(k);
  chart.series.push_back(s);
  EXPECT_NE(chart_table(chart).find("every 10th of 400 places"), std::string::npos);
}

TEST(Chart, WithoutPointsThereIsNoFigure) {
  ChartBook book;
  EXPECT_EQ(book.figure({.title = "t", .series = {{.name = "empty"}}}), "");
  EXPECT_TRUE(book.charts().empty());
}

TEST(Chart, CsvQuotesAndLeavesGapsEmpty) {
  const std::string csv = chart_csv(sample());
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "series,frame,FPS (1/s),low,high");
  EXPECT_NE(csv.find("\"a, b\",1.0,10.0,9.0,11.0\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",2.0,,,\n"), std::string::npos) << csv;
}

TEST(Chart, PicturesOfBothKinds) {
  EXPECT_NE(chart_svg(sample(), plots::Placement::kFile).find("<svg"), std::string::npos);
  Chart down{.title = "t", .x = {.name = "ratio"}, .y = {.name = "engine", .categories = {"one", "two"}}};
  down.series.push_back(
      {.name = "r", .kind = SeriesKind::kPoints, .x = {1, 2}, .y = {0, 1}, .low = {0.9, 1.8}, .high = {1.1, 2.2}});
  const std::string svg = chart_svg(down, plots::Placement::kInline);
  EXPECT_NE(svg.find("one"), std::string::npos);
  EXPECT_EQ(svg.find("<script"), std::string::npos);
}

TEST(Chart, ALongTitleGoesOnBelow) {
  Chart chart{.title = "Time per frame relative to octree-cpu: integrate, broad, levels, vertices, response, faces",
              .x = {.name = "frame"},
              .y = {.name = "ratio"}};
  chart.series.push_back({.name = "s", .x = {1, 2}, .y = {1, 2}});
  const std::string svg = chart_svg(chart, plots::Placement::kFile);
  EXPECT_NE(svg.find("y=\"22\">Time per frame"), std::string::npos);
  EXPECT_NE(svg.find("y=\"39\">"), std::string::npos) << "the second line";
  EXPECT_NE(svg.find("faces</text>"), std::string::npos);
  chart.title = "short";
  EXPECT_EQ(chart_svg(chart, plots::Placement::kFile).find("y=\"39\">"), std::string::npos);
}

TEST(Chart, PicturesShowTheLinesThatThePageShows) {
  Chart history{.title = "t", .x = {.name = "run"}, .y = {.name = "median frame", .unit = "ms"}};
  history.series.push_back({.name = "median frame", .x = {1, 2, 3, 4, 5}, .y = {10, 10, 13, 13, 13}});
  history.marks = {{kHostile, 3.0, false}, {"limit", 20.0, true}};
  const std::string svg = chart_svg(history, plots::Placement::kFile);
  const auto lines = [](const std::string& text) {
    std::size_t count = 0;
    for (auto at = text.find("<line class=\"across\""); at != std::string::npos;
         at = text.find("<line class=\"across\"", at + 1))
      ++count;
    return count;
  };
  EXPECT_EQ(lines(svg), 2U) << "one at the change, one at a limit that lies above all values";
  EXPECT_NE(svg.find(">limit</text>"), std::string::npos);
  EXPECT_EQ(svg.find("<script"), std::string::npos);

  Chart ratio{.title = "t", .x = {.name = "ratio"}, .y = {.name = "engine", .categories = {"one"}}};
  ratio.series.push_back({.name = "r", .kind = SeriesKind::kPoints, .x = {1.2}, .y = {0}, .low = {1.1}, .high = {1.3}});
  ratio.marks = {{"equal", 1.0, false}};
  EXPECT_EQ(lines(chart_svg(ratio, plots::Placement::kInline)), 1U) << "bars stand upright: their values are on y";
}

}  // namespace
}  // namespace broadside::reports

// Plots: shapes lie where the numbers say, names from outside are never markup, and absence is a word.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "reports/plots/axis.hpp"
#include "reports/plots/bar_plot.hpp"
#include "reports/plots/heat_map.hpp"
#include "reports/plots/histogram.hpp"
#include "reports/plots/line_plot.hpp"
#include "reports/plots/plot_style.hpp"
#include "tests/reports/markup_checker.hpp"

namespace broadside::reports::plots {
namespace {

using testing_markup::check_markup;
using testing_markup::Element;
using testing_markup::Markup;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const std::string kHostileLabel = "<script>&\"'\x01\xff";

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> words;
  for (const Tick& tick : axis.ticks()) words.push_back(tick.label);
  return words;
}

Markup parsed(const std::string& text) {
  Markup markup = check_markup(text, false);
  EXPECT_EQ(markup.problem, "") << text.substr(0, 400);
  return markup;
}

std::vector<Element> with_class(const Markup& markup, const std::string& element, const std::string& style) {
  std::vector<Element> found;
  for (const Element& e : markup.elements)
    if (e.name == element && e.attributes.contains("class") && e.attributes.at("class") == style) found.push_back(e);
  return found;
}

double number(const Element& e, const std::string& name) {
  return std::strtod(e.attributes.at(name).c_str(), nullptr);
}

PlotText words(const std::string& title) {
  return {title, "what " + title + " shows", "frame", "FPS"};
}

TEST(Axis, LinearTicksAreOneTwoOrFiveTimesAPowerOfTen) {
  const std::vector<double> values{0.0, 113.66, 55.6};
  const Axis axis(Scale::kLinear, values, true);
  EXPECT_EQ(labels(axis), (std::vector<std::string>{"0", "20", "40", "60", "80", "100", "120"}));
  EXPECT_DOUBLE_EQ(axis.share(60.0), 0.5);
  const std::vector<double> small{0.0, 0.0013};
  EXPECT_EQ(labels(Axis(Scale::kLinear, small, true)), (std::vector<std::string>{"0", "0.0005", "0.001", "0.0015"}));
}

TEST(Axis, HoldsNegativeValuesAndZero) {
  const std::vector<double> values{-53.4, -11.3};
  const Axis axis(Scale::kLinear, values, true);
  EXPECT_EQ(labels(axis).front(), "-60");
  EXPECT_EQ(labels(axis).back(), "0");
}

TEST(Axis, LogTicksArePowersOfTenAndFillWhereTheyAreFew) {
  const std::vector<double> wide{1.0, 1e6};
  EXPECT_EQ(labels(Axis(Scale::kLog, wide, false)).size(), 7U);
  const std::vector<double> narrow{30.0, 400.0};
  EXPECT_EQ(labels(Axis(Scale::kLog, narrow, false)), (std::vector<std::string>{"20", "50", "100", "200", "500"}));
  EXPECT_NEAR(Axis(Scale::kLog, wide, false).share(1e3), 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(Axis(Scale::kLog, wide, false).share(0.0)));
}

TEST(Axis, NothingOneValueAndNotANumberStillGiveAnAxis) {
  const std::vector<double> none{};
  const std::vector<double> one{42.0};
  const std::vector<double> odd{kNan, INFINITY, -3.0};
  for (const Scale scale : {Scale::kLinear, Scale::kLog})
    for (const auto& values : {none, one, odd})
      for (const bool from_zero : {false, true}) {
        const Axis axis(scale, values, from_zero);
        EXPECT_LT(axis.low(), axis.high());
        EXPECT_GE(axis.ticks().size(), 2U);
        EXPECT_LT(axis.ticks().size(), 14U);
      }
}

TEST(LinePlot, PointsAndBandLieWhereTheNumbersSay) {
  LinePlot plot{.text = words("line"), .curves = {{"octree", {0, 50, 100}, {0, 50, 100}, {0, 40, 90}, {0, 60, 100}}}};
  const Markup markup = parsed(svg(plot));
  const auto marks = with_class(markup, "circle", "s0");
  // The legend's sample comes first.
  ASSERT_EQ(marks.size(), 4U);
  EXPECT_NEAR(number(marks[2], "cx"), 0.5 * (number(marks[1], "cx") + number(marks[3], "cx")), 0.02);
  EXPECT_NEAR(number(marks[2], "cy"), 0.5 * (number(marks[1], "cy") + number(marks[3], "cy")), 0.02);
  EXPECT_GT(number(marks[1], "cy"), number(marks[3], "cy")) << "larger values are higher on the picture";
  EXPECT_EQ(with_class(markup, "path", "band b0").size(), 1U);
  EXPECT_EQ(with_class(markup, "path", "curve l0").size(), 1U);
}

TEST(LinePlot, AGapBreaksTheLineAndAFittedLineSharesTheColorOfItsCurve) {
  LinePlot plot{.text = words("log"), .x_scale = Scale::kLog, .y_scale = Scale::kLog};
  plot.curves.push_back({"flat", {10, 100, 1000, 10000, 100000}, {1, 2, kNan, 4, 5}});
  plot.curves.push_back({.name = "b N + c N^2", .x = {10, 100000}, .y = {1, 5}, .is_fitted = true});
  plot.curves.push_back({"tree", {10, 100}, {3, 4}});
  const Markup markup = parsed(svg(plot));
  const auto curves = with_class(markup, "path", "curve l0");
  ASSERT_EQ(curves.size(), 1U);
  const std::string data = curves[0].attributes.at("d");
  EXPECT_EQ(std::count(data.begin(), data.end(), 'M'), 2) << data;
  EXPECT_EQ(with_class(markup, "path", "fitted l0").size(), 1U);
  EXPECT_EQ(with_class(markup, "path", "curve l2").size(), 1U);
}

TEST(BarPlot, HeightsAreProportionalAndAbsenceIsAWord) {
  BarPlot plot{.text = words("bars"),
               .groups = {"bunny 300", "bunny 350"},
               .series = {{"A", {50, 100}, {5, 10}}, {"B", {25, kNan}, {}}}};
  const std::string text = svg(plot);
  const Markup markup = parsed(text);
  const auto a = with_class(markup, "rect", "s0");
  const auto b = with_class(markup, "rect", "s1");
  ASSERT_EQ(a.size(), 3U);  // with the legend's sample
  ASSERT_EQ(b.size(), 2U);
  EXPECT_NEAR(number(a[2], "height"), 2.0 * number(a[1], "height"), 0.03);
  EXPECT_NEAR(number(a[1], "height"), 2.0 * number(b[1], "height"), 0.03);
  EXPECT_EQ(with_class(markup, "line", "whisker").size(), 6U);
  EXPECT_NE(text.find(">absent<"), std::string::npos);
}

TEST(HeatMap, TheLargestValueIsTheFullestCell) {
  HeatMap map{words("penetration"), "m", {"0.2", "1"}, {"0.5 mm", "1 mm"}, {{0.004, 0.001}, {0.003, kNan}}};
  const std::string text = svg(map);
  const Markup markup = parsed(text);
  std::vector<double> shades;
  for (const Element& e : with_class(markup, "rect", "s0"))
    if (number(e, "height") > 20.0) shades.push_back(number(e, "fill-opacity"));
  ASSERT_EQ(shades.size(), 4U);
  EXPECT_DOUBLE_EQ(shades[0], 1.0);
  EXPECT_LT(shades[1], shades[2]);
  EXPECT_DOUBLE_EQ(shades[3], 0.0);
  EXPECT_NE(text.find(">4 mm<"), std::string::npos);
  EXPECT_NE(text.find("absent"), std::string::npos);
}

TEST(Histogram, EveryFiniteValueIsInOneBin) {
  const std::vector<double> values{0.0, 0.1, 0.5, 0.99, 1.0, kNan, INFINITY};
  const Bins bins = bins_of(values, 4);
  EXPECT_EQ(bins.counts, (std::vector<std::uint64_t>{2, 0, 1, 2}));
  EXPECT_EQ(bins.edges, (std::vector<double>{0.0, 0.25, 0.5, 0.75, 1.0}));
  const std::vector<double> decades{1.0, 10.0, 99.0, 1000.0, 0.0, -5.0};
  EXPECT_EQ(bins_of(decades, 3, Scale::kLog).counts, (std::vector<std::uint64_t>{1, 2, 1}));
  const std::vector<double> one{3.0};
  EXPECT_EQ(bins_of(one, 2).counts.size(), 2U);
  EXPECT_TRUE(bins_of({}, 5).counts.empty());
  const Markup markup = parsed(svg(Histogram{words("ratio"), Scale::kLinear, bins}));
  EXPECT_EQ(with_class(markup, "rect", "s0").size(), 4U);
}

// What every plot must have: a text for readers who cannot see it, and safety with hostile names.
TEST(Plots, NamesAreEscapedAndTitlesAreThere) {
  const PlotText text{kHostileLabel, kHostileLabel, kHostileLabel, kHostileLabel};
  const std::vector<double> two{1.0, 2.0};
  const std::vector<std::string> pictures{
      svg(LinePlot{.text = text, .curves = {{kHostileLabel, two, two}}}),
      svg(BarPlot{.text = text, .groups = {kHostileLabel}, .series = {{kHostileLabel, {1.0}, {}}}}),
      svg(HeatMap{text, kHostileLabel, {kHostileLabel}, {kHostileLabel}, {{1.0}}}),
      svg(Histogram{text, Scale::kLinear, bins_of(two, 2)}),
  };
  for (const std::string& picture : pictures) {
    const Markup markup = parsed(picture);
    EXPECT_EQ(markup.count("script"), 0U);
    EXPECT_EQ(markup.count("desc"), 1U);
    ASSERT_FALSE(markup.elements.empty());
    const Element& root = markup.elements[0];
    EXPECT_EQ(root.attributes.at("role"), "img");
    const std::string named_by = root.attributes.at("aria-labelledby");
    EXPECT_EQ(named_by.substr(0, named_by.find(' ')), markup.elements[1].attributes.at("id"));
    EXPECT_EQ(picture.find('\x01'), std::string::npos);
  }
}

TEST(Plots, WithoutDataTheySaySo) {
  for (const std::string& picture :
       {svg(LinePlot{.text = words("a")}), svg(LinePlot{.text = words("b"), .curves = {{"c", {1.0}, {kNan}}}}),
        svg(BarPlot{.text = words("d"), .groups = {"g"}, .series = {{"s", {kNan}, {}}}}),
        svg(HeatMap{words("e"), "", {}, {}, {}}), svg(Histogram{words("f"), Scale::kLinear, {}})}) {
    parsed(picture);
    EXPECT_NE(picture.find("no data"), std::string::npos);
  }
}

TEST(Plots, AFileHasItsOwnStyleAndAnInlinePictureThePages) {
  const LinePlot plot{.text = words("a"), .curves = {{"c", {1.0, 2.0}, {1.0, 2.0}}}};
  const std::string file = svg(plot, Placement::kFile);
  const std::string part = svg(plot, Placement::kInline);
  EXPECT_NE(file.find("prefers-color-scheme:dark"), std::string::npos);
  EXPECT_NE(file.find("xmlns="), std::string::npos);
  EXPECT_EQ(part.find("<style"), std::string::npos);
  EXPECT_EQ(svg(plot), svg(plot)) << "the same rows give the same bytes";
  EXPECT_EQ(plot_style().find('#'), std::string::npos) << "a page's colors are its variables";
}

TEST(Plots, ThePaletteIsThatOfTheReport) {
  std::ifstream file(BROADSIDE_SOURCE_DIR "/reports/page/report.css");
  const std::string css{std::istreambuf_iterator<char>(file), {}};
  ASSERT_FALSE(css.empty());
  for (const char* color : {"--s0: #2f5d8c", "--s0: #5a92c9", "--s7: #a08a5b", "--s7: #c4ae7f", "--fail: #b3201c"}) {
    ASSERT_NE(css.find(color), std::string::npos) << color;
    EXPECT_NE(file_style().find(std::string(color).substr(std::string(color).find('#'))), std::string::npos) << color;
  }
}

// To look at them: BROADSIDE_PLOT_PREVIEW=some/folder ctest -R PlotPreview
TEST(PlotPreview, IsWrittenWhereAsked) {
  const char* folder = std::getenv("BROADSIDE_PLOT_PREVIEW");
  if (folder == nullptr) GTEST_SKIP() << "BROADSIDE_PLOT_PREVIEW is not set";
  const auto save = [&](const std::string& name, const std::string& picture) {
    std::ofstream(std::string(folder) + "/" + name + ".svg") << picture;
  };
  LinePlot line{.text = {"Frames per second over the run", "two curves", "frame", "FPS"}};
  for (int method = 0; method < 2; ++method) {
    Curve curve{.name = method == 0 ? "hash" : "octree"};
    for (int k = 1; k <= 30; ++k) {
      const double y = 300.0 - 4.0 * k * (2 - method) + 9.0 * std::sin(k);
      curve.x.push_back(100.0 * k);
      curve.y.push_back(y);
      curve.low.push_back(y - 12.0);
      curve.high.push_back(y + 12.0);
    }
    line.curves.push_back(curve);
  }
  save("line", svg(line));
  LinePlot log{.text = {"Cost against count", "a model", "bodies", "time per frame, ms"},
               .x_scale = Scale::kLog,
               .y_scale = Scale::kLog};
  log.curves.push_back({"flat", {300, 900, 3000, 9000, 30000}, {0.1, 0.4, 3, 24, 250}});
  log.curves.push_back({.name = "b N + c N\xC2\xB2", .x = {300, 30000}, .y = {0.05, 240}, .is_fitted = true});
  log.curves.push_back({"tree", {300, 900, 3000, 9000, 30000}, {0.2, 0.3, 0.9, 2.2, 7}});
  save("log", svg(log));
  save("bars", svg(BarPlot{.text = {"Levels", "bars", "model and bodies", "FPS"},
                           .groups = {"bunny 300", "bunny 350", "dragon 150", "dragon 300"},
                           .series = {{"A", {55, 42, 29, 8.8}, {2, 1, 2, 1}},
                                      {"B", {113, 89, 60, kNan}, {1, 1, 1, 1}},
                                      {"C", {98, 55, 48, 13}, {1, 1, 1, 1}}}}));
  save("heat", svg(HeatMap{{"Mean penetration", "heat", "beta", "delta"},
                           "m",
                           {"0.2", "0.4", "0.6", "0.8", "1"},
                           {"0.5 mm", "1 mm", "2 mm"},
                           {{0.004, 0.003, 0.002, 0.001, 0.0009},
                            {0.005, 0.004, 0.002, 0.002, 0.001},
                            {0.006, 0.005, 0.004, kNan, 0.002}}}));
}

}  // namespace
}  // namespace broadside::reports::plots

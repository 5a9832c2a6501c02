// Comparisons over several scenes or days: cost against the number of bodies, and the history of earlier runs.
#include <algorithm>
#include <cmath>
#include <set>

#include "reports/element.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"
#include "reports/scaling.hpp"

namespace broadside::reports {
namespace {

constexpr std::size_t kMostHistories = 24;

std::string exponent_row(const ScalingSeries& s) {
  std::string interval =
      std::isfinite(s.law.low) ? figure(s.law.low) + " to " + figure(s.law.high) : "none: only two body counts";
  return element("tr", row_head(html(s.family)), text_cell("engine", html(s.label)),
                 figure_cell("exponent", html(figure(s.law.exponent))), figure_cell("95 % interval", html(interval)),
                 figure_cell("counts", counted(s.n.size())));
}

// The series of the cells in this report, those with a change first.
std::vector<const HistorySeries*> relevant(const PageParts& page) {
  std::set<std::pair<std::string, std::string>> cells;
  for (const core::Cell& cell : page.rows.cells) cells.insert({cell.stamp.scene_name, cell.stamp.label()});
  for (const core::Sample& sample : page.rows.samples) cells.insert({sample.stamp.scene_name, sample.stamp.label()});
  std::vector<const HistorySeries*> found;
  for (const HistorySeries& s : page.options.history)
    if (s.points.size() > 1 && cells.contains({s.scene, s.label})) found.push_back(&s);
  const auto rank = [](const HistorySeries* s) {
    return (s->changes.empty() ? 2 : 0) + (s->metric == "median frame" ? 0 : 1);
  };
  std::stable_sort(found.begin(), found.end(), [&](const auto* a, const auto* b) { return rank(a) < rank(b); });
  return found;
}

Chart history_chart(const HistorySeries& s) {
  Chart chart{.title = s.scene + " " + s.label + ": " + s.metric,
              .description = s.metric + " of " + s.label + " on " + s.scene + " over " +
                             counted(s.points.size(), "run") + " on " + s.machine + ", with " +
                             counted(s.changes.size(), "change point") + ".",
              .x = {.name = "run"},
              .y = {.name = s.metric, .unit = s.unit}};
  double scale = 1.0;
  if (s.unit == "s") {
    const TimeUnit unit = time_unit_for(s.points.back().value);
    chart.y.unit = unit.name;
    scale = unit.per_second;
  }
  Series line{.name = s.metric};
  for (const HistoryPoint& p : s.points) {
    line.x.push_back(static_cast<double>(p.run));
    line.y.push_back(p.value * scale);
  }
  chart.series.push_back(std::move(line));
  for (const ChangePoint& change : s.changes)
    chart.marks.push_back({figure(change.before * scale) + " to " + figure(change.after * scale),
                           static_cast<double>(s.points[change.index].run), false});
  return chart;
}

}  // namespace

std::string scaling_section(PageParts& page) {
  const std::vector<ScalingSeries> all = scaling_series(page.rows);
  if (all.empty()) return "";
  std::vector<std::string> families;
  for (const ScalingSeries& s : all)
    if (std::find(families.begin(), families.end(), s.family) == families.end()) families.push_back(s.family);
  std::string figures;
  for (const std::string& family : families) {
    Chart chart{.title = "Cost against the number of bodies: " + family,
                .description = "Median time per frame of each engine against the number of bodies in " + family +
                               ", both axes logarithmic, with the 5th to 95th percentile of frames.",
                .x = {.name = "bodies", .is_log = true},
                .y = {.name = "time per frame", .unit = "ms", .is_log = true}};
    for (const ScalingSeries& s : all) {
      if (s.family != family) continue;
      Series line{.name = s.label, .x = s.n};
      for (std::size_t k = 0; k < s.n.size(); ++k) {
        line.y.push_back(1e3 * s.seconds[k]);
        line.low.push_back(1e3 * s.p5[k]);
        line.high.push_back(1e3 * s.p95[k]);
      }
      chart.series.push_back(std::move(line));
    }
    figures += page.charts.figure(std::move(chart));
  }
  std::string rows;
  for (const ScalingSeries& s : all) rows += exponent_row(s);
  return element(
      "section", {{"id", "scaling"}}, element("h2", "Cost against the number of bodies"),
      element("div.charts", figures),
      element("table", element("caption", "Exponent k of time ~ N<sup>k</sup>, by least squares on logarithms"),
              table_head({{"scenes"}, {"engine"}, {"exponent", true}, {"95 % interval", true}, {"counts", true}}),
              element("tbody", rows)));
}

std::string history_section(PageParts& page) {
  const std::vector<const HistorySeries*> found = relevant(page);
  if (found.empty()) return "";
  std::string figures;
  for (std::size_t k = 0; k < std::min(found.size(), kMostHistories); ++k)
    figures += page.charts.figure(history_chart(*found[k]));
  std::string left_out;
  if (found.size() > kMostHistories)
    left_out = " " + counted(found.size() - kMostHistories) +
               " more series without a change are left out: 'broadside history' lists them.";
  return element("section", {{"id", "history"}}, element("h2", "Earlier runs"),
                 element("p.hint",
                         "Each point is a run on this machine; dashed lines are change points, with the means before "
                         "and after.",
                         left_out),
                 element("div.charts", figures));
}

}  // namespace broadside::reports

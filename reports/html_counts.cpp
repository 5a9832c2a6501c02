// Pair counts and precision of a scene's engines, and series over steps from recording or judging.
#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "reports/element.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"

namespace broadside::reports {
namespace {

constexpr std::string_view kKinds[] = {"raw", "candidates", "confirmed", "touching", "contacts", "measured"};

// The mean of "pairs: KIND, mean"; negative when the cell has none.
double mean_of(const core::Cell& cell, std::string_view kind) {
  const auto note = cell.notes.find("pairs: " + std::string(kind) + ", mean");
  if (note == cell.notes.end()) return -1.0;
  char* end = nullptr;
  const double value = std::strtod(note->second.c_str(), &end);
  return end == note->second.c_str() ? -1.0 : value;
}

}  // namespace

std::string counts_section(const SceneView& scene, PageParts& page) {
  Chart chart{.title = "Pairs per frame, mean",
              .x = {.name = "pairs", .is_log = false, .from_zero = true},
              .y = {.name = "engine"}};
  std::string precision;
  for (const std::string_view kind : kKinds)
    chart.series.push_back({.name = std::string(kind), .kind = SeriesKind::kBar});
  for (const TraceView& trace : scene.traces) {
    if (trace.cell == nullptr) continue;
    const auto row = static_cast<double>(chart.y.categories.size());
    bool has_any = false;
    for (std::size_t k = 0; k < std::size(kKinds); ++k) {
      const double mean = mean_of(*trace.cell, kKinds[k]);
      if (mean < 0.0) continue;
      chart.series[k].x.push_back(mean);
      chart.series[k].y.push_back(row);
      has_any = true;
    }
    if (!has_any) continue;
    chart.y.categories.push_back(trace.label);
    const double raw = mean_of(*trace.cell, "raw");
    const double tight = mean_of(*trace.cell, "candidates");
    if (raw > 0.0 && tight >= 0.0)
      precision += element(
          "tr", row_head(label_html(trace.stamp, trace.label)), figure_cell("reported", html(figure(raw, 4))),
          figure_cell("overlapping", html(figure(tight, 4))), figure_cell("precision", html(percent(tight / raw))));
  }
  std::erase_if(chart.series, [](const Series& s) { return s.x.empty(); });
  chart.description = "Mean pairs per frame of each engine on " + scene.name + ", by kind.";
  const std::string drawn = page.charts.figure(std::move(chart));
  if (drawn.empty()) return "";
  std::string table;
  if (!precision.empty())
    table =
        element("table.precision",
                element("caption",
                        "Precision of the broad phase: the share of the pairs an engine reports whose boxes really "
                        "overlap"),
                table_head({{"engine"}, {"reported", true, "per frame"}, {"overlapping", true}, {"precision", true}}),
                element("tbody", precision));
  return element("section", element("h3", "Pairs"), element("div.charts", drawn), table);
}

// One chart per subject, each trace with its columns.
std::string frame_series_section(const SceneView& scene, PageParts& page) {
  std::vector<std::string> subjects;
  for (const FrameSeries& series : page.options.series)
    if (series.stamp.scene_digest == scene.digest &&
        std::find(subjects.begin(), subjects.end(), series.subject) == subjects.end())
      subjects.push_back(series.subject);
  std::string out;
  for (const std::string& subject : subjects) {
    Chart chart{
        .title = subject + " over the run",
        .description = "How " + subject + " changed during the run of " + scene.name + ", for each recorded engine.",
        .x = {.name = "step"},
        .y = {.name = subject},
        .has_zoom = true};
    for (const FrameSeries& series : page.options.series) {
      if (series.stamp.scene_digest != scene.digest || series.subject != subject) continue;
      chart.y.unit = series.unit;
      for (const FrameColumn& column : series.columns) {
        Series line{.name = series.stamp.label() + ": " + column.name};
        for (std::size_t k = 0; k < std::min(series.steps.size(), column.values.size()); ++k) {
          line.x.push_back(static_cast<double>(series.steps[k]));
          line.y.push_back(column.values[k]);
        }
        chart.series.push_back(std::move(line));
      }
    }
    const std::string figure = page.charts.figure(std::move(chart));
    if (!figure.empty()) {
      std::string title = subject;
      title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
      out += element("section", element("h3", html(title)), element("div.charts", figure));
    }
  }
  return out;
}

}  // namespace broadside::reports

// Pair counts and precision of a scene's engines, and series over steps from recording or judging.
#include <algorithm>
#include <cctype>
#include <cstdlib>

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
      precision += "<tr><th scope=\"row\">" + label_html(trace.stamp, trace.label) +
                   "</th><td class=\"figure\" data-name=\"reported\">" + html(figure(raw, 4)) +
                   "</td><td class=\"figure\" data-name=\"overlapping\">" + html(figure(tight, 4)) +
                   "</td><td class=\"figure\" data-name=\"precision\">" + html(percent(tight / raw)) + "</td></tr>";
  }
  std::erase_if(chart.series, [](const Series& s) { return s.x.empty(); });
  chart.description = "Mean pairs per frame of each engine on " + scene.name + ", by kind.";
  std::string out = page.charts.figure(std::move(chart));
  if (out.empty()) return "";
  out = "<section><h3>Pairs</h3><div class=\"charts\">" + out + "</div>";
  if (!precision.empty())
    out +=
        "<table class=\"precision\"><caption>Precision of the broad phase: of the pairs that an engine reports, how "
        "many "
        "boxes really overlap</caption><thead><tr><th scope=\"col\">engine</th><th scope=\"col\" "
        "class=\"figure\">reported"
        "<small>per frame</small></th><th scope=\"col\" class=\"figure\">overlapping</th><th scope=\"col\" "
        "class=\"figure\">precision</th></tr></thead><tbody>" +
        precision + "</tbody></table>";
  return out + "</section>";
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
        .description = "How " + subject + " went along the run of " + scene.name + ", for each recorded engine.",
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
      out += "<section><h3>" + html(title) + "</h3><div class=\"charts\">" + figure + "</div></section>";
    }
  }
  return out;
}

}  // namespace broadside::reports

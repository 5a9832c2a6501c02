// The energy ledger of each run, as curves over its frames.
#include <algorithm>

#include "reports/element.hpp"
#include "reports/html_sections.hpp"

namespace broadside::reports {
namespace {

// A curve of this width cannot show more points.
constexpr std::size_t kMostPoints = 320;

// The indices of every k-th frame, and of the last.
std::vector<std::size_t> shown(std::size_t frames) {
  std::vector<std::size_t> at;
  const std::size_t stride = std::max<std::size_t>(1, (frames + kMostPoints - 1) / kMostPoints);
  for (std::size_t k = stride - 1; k < frames; k += stride) at.push_back(k);
  if (frames > 0 && (at.empty() || at.back() + 1 != frames)) at.push_back(frames - 1);
  return at;
}

// sums: the work since the start rather than that of each frame.
Series curve(const core::EnergySeries& series, std::size_t column, bool sums) {
  Series out{.name = std::string(core::kEnergyColumns[column])};
  std::vector<double> values = series.joule[column];
  if (sums)
    for (std::size_t k = 1; k < values.size(); ++k) values[k] += values[k - 1];
  for (const std::size_t k : shown(series.step.size())) {
    out.x.push_back(static_cast<double>(series.step[k]));
    out.y.push_back(values[k]);
  }
  return out;
}

Chart chart(const core::EnergySeries& series, const std::string& title, const std::string& description,
            std::size_t first, std::size_t last, bool sums) {
  Chart chart{.title = title + ": " + series.scene_name + ", " + series.label,
              .description = description,
              .x = {.name = "frame"},
              .y = {.name = "energy", .unit = "J"},
              .has_zoom = true};
  for (std::size_t column = first; column < last; ++column) chart.series.push_back(curve(series, column, sums));
  return chart;
}

}  // namespace

std::string energy_section(PageParts& page) {
  std::string out;
  for (const core::EnergySeries& series : page.options.energy) {
    if (series.step.empty()) continue;
    out += page.charts.figure(
        chart(series, "Energy", "Kinetic and potential energy at the end of each frame.", 0, 2, false));
    out += page.charts.figure(
        chart(series, "Work since the start",
              "Energy that integration, normal impulses, friction, position correction and the velocity cap added "
              "or removed.",
              2, core::kEnergyColumnCount, true));
  }
  if (out.empty()) return out;
  return element("section.energy", {{"id", "energy"}}, element("h2", "Where the energy went"), "\n",
                 element("p",
                         "In every frame the energy must change by the sum of these works, within rounding. The "
                         "validator energy checks this."),
                 "\n", element("div.charts", out)) +
         "\n";
}

}  // namespace broadside::reports

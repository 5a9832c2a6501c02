#include "reports/plots/bar_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/figures.hpp"
#include "reports/plots/plot_style.hpp"

namespace broadside::reports::plots {
namespace {

constexpr double kBarShare = 0.8;  // of a group's width; the rest is the gap to the next

double error_of(const BarSeries& series, std::size_t group) {
  const double error = group < series.errors.size() ? series.errors[group] : 0.0;
  return std::isfinite(error) ? error : 0.0;
}

double value_of(const BarSeries& series, std::size_t group) {
  return group < series.values.size() ? series.values[group] : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> extent(const BarPlot& plot) {
  std::vector<double> values;
  for (const BarSeries& series : plot.series)
    for (std::size_t g = 0; g < plot.groups.size(); ++g)
      for (const double sign : {-1.0, 0.0, 1.0}) values.push_back(value_of(series, g) + sign * error_of(series, g));
  for (const CrossLine& line : plot.lines)
    if (line.is_on_y) values.push_back(line.at);
  return values;
}

}  // namespace

std::string svg(const BarPlot& plot, Placement placement) {
  const std::vector<double> values = extent(plot);
  const Axis y(plot.y_scale, values, true);
  Drawing drawing(kPlotWidth, kPlotHeight, plot.text.title, plot.text.description);
  std::vector<LegendEntry> legend;
  for (std::size_t s = 0; s < plot.series.size(); ++s)
    legend.push_back({plot.series[s].name, "s" + std::to_string(s % kSeriesColors), LegendEntry::kSwatch});
  const Area area = area_below(draw_head(drawing, plot.text.title, legend), y);
  draw_y_axis(drawing, area, y, plot.text.y_label);
  draw_x_names(drawing, area, plot.groups, plot.text.x_label);

  const double group_width =
      (area.right - area.left) / static_cast<double>(std::max<std::size_t>(1, plot.groups.size()));
  const double width = kBarShare * group_width / static_cast<double>(std::max<std::size_t>(1, plot.series.size()));
  const double foot = area.y(plot.y_scale == Scale::kLinear ? y.share(0.0) : 0.0);
  bool is_empty = true;
  for (std::size_t g = 0; g < plot.groups.size(); ++g) {
    for (std::size_t s = 0; s < plot.series.size(); ++s) {
      const double left = area.left + static_cast<double>(g) * group_width + 0.5 * (1.0 - kBarShare) * group_width +
                          static_cast<double>(s) * width;
      const double value = value_of(plot.series[s], g);
      const double middle = left + 0.5 * width;
      if (!std::isfinite(y.share(value))) {
        drawing.upright_text("tick", {middle + 3.7, foot - 20.0}, "absent");
        continue;
      }
      is_empty = false;
      const double head = area.y(y.share(value));
      drawing.rect(
          "s" + std::to_string(s % kSeriesColors), {left, std::min(head, foot)}, std::max(0.5, width - 1.0),
          std::abs(foot - head),
          plot.groups[g] + ", " + plot.series[s].name + ": " + figure(value, 4) +
              (error_of(plot.series[s], g) > 0.0 ? " \xC2\xB1 " + figure(error_of(plot.series[s], g), 2) : ""));
      const double error = error_of(plot.series[s], g);
      if (!(error > 0.0)) continue;
      const double up = area.y(y.share(value + error));
      const double low_share = y.share(value - error);
      const double down = area.y(std::isfinite(low_share) ? low_share : 0.0);
      drawing.line("whisker", {middle, up}, {middle, down});
      for (const double end : {up, down}) drawing.line("whisker", {middle - 2.5, end}, {middle + 2.5, end});
    }
  }
  draw_cross_lines(drawing, area, plot.lines, nullptr, y);
  if (is_empty) draw_absence(drawing, area);
  return drawing.finish(placement);
}

}  // namespace broadside::reports::plots

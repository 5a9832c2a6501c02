#include "reports/chart_svg.hpp"

#include <cctype>
#include <limits>
#include <utility>

#include "core/whole_file.hpp"
#include "reports/plots/bar_plot.hpp"
#include "reports/plots/line_plot.hpp"

namespace broadside::reports {
namespace {

std::string label_of(const Axis& axis) {
  return axis.unit.empty() ? axis.name : axis.name + ", " + axis.unit;
}

// A bar's value is always on y here, even where the chart is drawn sideways; a mark between two categories has no
// place.
std::vector<plots::CrossLine> lines_of(const Chart& chart, bool values_on_x) {
  std::vector<plots::CrossLine> lines;
  for (const ChartMark& mark : chart.marks) lines.push_back({mark.text, mark.at, mark.is_on_y != values_on_x});
  return lines;
}

// Categories become groups; a series without a value in a group has no bar there.
std::string bars(const Chart& chart, bool is_down, plots::Placement placement) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Axis& along = is_down ? chart.y : chart.x;
  const Axis& of = is_down ? chart.x : chart.y;
  plots::BarPlot plot;
  plot.text = {chart.title, chart.description, along.name, label_of(of)};
  plot.y_scale = of.is_log ? plots::Scale::kLog : plots::Scale::kLinear;
  plot.groups = along.categories;
  for (const Series& s : chart.series) {
    plots::BarSeries bars{s.name, std::vector<double>(plot.groups.size(), kNone), {}};
    if (!s.low.empty()) bars.errors.assign(plot.groups.size(), kNone);
    for (std::size_t k = 0; k < s.x.size(); ++k) {
      const auto group = static_cast<std::size_t>(is_down ? s.y[k] : s.x[k]);
      if (group >= plot.groups.size()) continue;
      bars.values[group] = is_down ? s.x[k] : s.y[k];
      if (!s.low.empty()) bars.errors[group] = 0.5 * (s.high[k] - s.low[k]);
    }
    plot.series.push_back(std::move(bars));
  }
  plot.lines = lines_of(chart, is_down);
  return plots::svg(plot, placement);
}

std::string file_name(const Chart& chart, std::size_t number) {
  std::string name = number < 9 ? "0" + std::to_string(number + 1) : std::to_string(number + 1);
  std::string words;
  for (const char c : chart.title) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_plain)
      words += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!words.empty() && words.back() != '-')
      words += '-';
  }
  while (!words.empty() && words.back() == '-') words.pop_back();
  constexpr std::size_t kLongest = 60;
  return name + "-" + words.substr(0, kLongest);
}

}  // namespace

std::string chart_svg(const Chart& chart, plots::Placement placement) {
  if (!chart.y.categories.empty()) return bars(chart, true, placement);
  if (!chart.x.categories.empty()) return bars(chart, false, placement);
  plots::LinePlot plot;
  plot.text = {chart.title, chart.description, label_of(chart.x), label_of(chart.y)};
  plot.x_scale = chart.x.is_log ? plots::Scale::kLog : plots::Scale::kLinear;
  plot.y_scale = chart.y.is_log ? plots::Scale::kLog : plots::Scale::kLinear;
  plot.y_from_zero = chart.y.from_zero;
  for (const Series& s : chart.series) plot.curves.push_back({s.name, s.x, s.y, s.low, s.high});
  plot.lines = lines_of(chart, false);
  return plots::svg(plot, placement);
}

core::Result<std::vector<std::filesystem::path>> write_charts(const std::vector<Chart>& charts,
                                                              const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed)
    return core::Error{"cannot make the folder: " + failed.message(), folder.string(), "choose another --plots"};
  std::vector<std::filesystem::path> written;
  for (std::size_t k = 0; k < charts.size(); ++k) {
    const std::string name = file_name(charts[k], k);
    const std::filesystem::path picture = folder / (name + ".svg");
    if (core::Status s = core::write_whole_file(picture, chart_svg(charts[k], plots::Placement::kFile)); !s)
      return s.error();
    if (core::Status s = core::write_whole_file(folder / (name + ".csv"), chart_csv(charts[k])); !s) return s.error();
    written.push_back(picture);
  }
  return written;
}

}  // namespace broadside::reports

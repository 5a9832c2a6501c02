// A chart as a value: the page draws it, a table beside it has the same figures, and it can be written to a file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace broadside::reports {

struct Axis {
  std::string name;  // "frame"
  std::string unit;  // "ms"; empty = none
  bool is_log = false;
  bool from_zero = false;
  // Names of the places 0, 1, 2, ... instead of a scale; the values of this axis are then these numbers. On the y axis
  // they run downwards.
  std::vector<std::string> categories = {};
};

enum class SeriesKind { kLine, kPoints, kBar, kArea };  // areas stack

// x and y have the same length. low and high have this length too, or are empty: they are a band around a line, or the
// whiskers of a point (along x where the y axis has categories).
struct Series {
  std::string name;
  SeriesKind kind = SeriesKind::kLine;
  std::vector<double> x, y;
  std::vector<double> low = {}, high = {};
  std::string stack = {};  // bars with the same stack name are stacked
};

// A line across the chart with a label: a limit, a change point.
struct ChartMark {
  std::string text;
  double at = 0.0;
  bool is_on_y = false;
};

struct Chart {
  std::string title;
  std::string description;  // what the chart shows, for readers who cannot see it; one or two sentences
  Axis x, y;
  std::vector<Series> series;
  std::vector<ChartMark> marks = {};
  bool has_zoom = false;
};

// Charts of one page, in the order in which they were added.
class ChartBook {
 public:
  // The HTML for a chart's place on the page: a plain picture, which a script replaces, and a table of its figures.
  // Long series are thinned in the table, and the table says so. Empty for a chart without points.
  std::string figure(Chart chart);

  [[nodiscard]] const std::vector<Chart>& charts() const { return charts_; }
  // For <script type="application/json">: escaped so that nothing in it can end the element.
  [[nodiscard]] std::string json() const;

 private:
  std::vector<Chart> charts_;
};

// The figures of a chart as an HTML table: one row per x, one column per series.
std::string chart_table(const Chart& chart);

// One line per point: series, x, y, low, high; quoted as RFC 4180 says.
std::string chart_csv(const Chart& chart);

}  // namespace broadside::reports

// What charts with two axes share: the rectangle of the data, grid, axis names, heading and legend.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/plots/axis.hpp"
#include "reports/plots/drawing.hpp"

namespace broadside::reports::plots {

// The words of a plot. The description replaces the picture for readers who cannot see it: say what it shows.
struct PlotText {
  std::string title;
  std::string description;
  std::string x_label;  // with the unit: "frame", "bodies", "time per frame, ms"
  std::string y_label;
};

inline constexpr double kPlotWidth = 640.0;
inline constexpr double kPlotHeight = 380.0;

struct LegendEntry {
  std::string name;
  std::string style;  // of the sample: "s2", or "fitted l2" for a dashed line
  int mark = 0;       // shape of Drawing::mark; kSwatch = a square of color, kLineOnly = a dashed line
  static constexpr int kSwatch = -1;
  static constexpr int kLineOnly = -2;
};

// A line across the data with a label beside it: a limit, a change point.
struct CrossLine {
  std::string text;
  double at = 0.0;
  bool is_on_y = false;  // at a value of y, so it runs from left to right
};

// The rectangle of the data; the rest of the picture is for words.
struct Area {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;

  [[nodiscard]] double x(double share) const { return left + share * (right - left); }
  [[nodiscard]] double y(double share) const { return bottom - share * (bottom - top); }
};

// Draws heading and legend, and returns the height that they take.
double draw_head(Drawing& drawing, std::string_view title, const std::vector<LegendEntry>& legend);

// Room for the labels of the y axis and the words around the data.
Area area_below(double head, const Axis& y);

void draw_y_axis(Drawing& drawing, const Area& area, const Axis& y, std::string_view label);
void draw_x_axis(Drawing& drawing, const Area& area, const Axis& x, std::string_view label);
// Draws a frame without ticks, with these names below equal parts of it.
void draw_x_names(Drawing& drawing, const Area& area, const std::vector<std::string>& names, std::string_view label);

// Lines outside their axis are left out, and so are all upright lines where there is no x axis. Labels that would
// overlap are drawn below each other.
void draw_cross_lines(Drawing& drawing, const Area& area, const std::vector<CrossLine>& lines, const Axis* x,
                      const Axis& y);

// Writes "no data", because an empty frame would not say that data is absent.
void draw_absence(Drawing& drawing, const Area& area);

}  // namespace broadside::reports::plots

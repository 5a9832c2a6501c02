#include "reports/plots/line_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/figures.hpp"
#include "reports/plots/plot_style.hpp"

namespace broadside::reports::plots {
namespace {

// Neighboring colors of the palette are similar, for stacked bars; curves that cross get colors that differ more.
constexpr std::array<int, kSeriesColors> kApart{0, 2, 3, 5, 1, 6, 4, 7};

std::string color_of(int curve) {
  return std::to_string(kApart[static_cast<std::size_t>(curve % kSeriesColors)]);
}

std::string mark_style(const Curve& curve, const std::string& color) {
  return (curve.is_hollow ? "hollow l" : "s") + color;
}

// Colors repeat after eight curves, with the next shape: 32 curves can be told apart.
int mark_of(int curve) {
  return (curve + curve / kSeriesColors) % 4;
}

// A legend of more than a few lines makes the picture taller and leaves the data its size.
constexpr double kUsualHead = 110.0;

constexpr std::size_t kMostMarks = 60;  // more would hide the curve

struct Columns {
  std::size_t count;
  bool has_band;
};

Columns columns_of(const Curve& curve) {
  const bool has_band = !curve.low.empty() && !curve.high.empty();
  std::size_t count = std::min(curve.x.size(), curve.y.size());
  if (has_band) count = std::min({count, curve.low.size(), curve.high.size()});
  return {count, has_band};
}

std::vector<double> all_x(const LinePlot& plot) {
  std::vector<double> values;
  for (const Curve& curve : plot.curves) values.insert(values.end(), curve.x.begin(), curve.x.end());
  return values;
}

std::vector<double> all_y(const LinePlot& plot) {
  std::vector<double> values;
  for (const Curve& curve : plot.curves)
    for (const std::vector<double>* column : {&curve.y, &curve.low, &curve.high})
      values.insert(values.end(), column->begin(), column->end());
  return values;
}

class Curves {
 public:
  Curves(Drawing& drawing, const Area& area, const Axis& x, const Axis& y)
      : drawing_(drawing), area_(area), x_(x), y_(y) {}

  // Each run of consecutive frames with a finite band is one polygon.
  void band(const Curve& curve, const std::string& style) {
    std::vector<Point> upper;
    std::vector<Point> lower;
    const auto close = [&] {
      upper.insert(upper.end(), lower.rbegin(), lower.rend());
      drawing_.polygon(style, upper);
      upper.clear();
      lower.clear();
    };
    for (std::size_t k = 0; k < columns_of(curve).count; ++k) {
      // Values below a log scale have no place: there the band ends at the axis.
      const double low = std::isfinite(y_.share(curve.low[k])) ? curve.low[k] : y_.low();
      const Point high_point = at(curve.x[k], curve.high[k]);
      if (!std::isfinite(curve.low[k]) || !std::isfinite(high_point.x) || !std::isfinite(high_point.y)) {
        close();
        continue;
      }
      upper.push_back(high_point);
      lower.push_back(at(curve.x[k], low));
    }
    close();
  }

  void line(const Curve& curve, const std::string& style) {
    std::vector<Point> points;
    for (std::size_t k = 0; k < columns_of(curve).count; ++k) points.push_back(at(curve.x[k], curve.y[k]));
    drawing_.polyline(style, points);
  }

  void marks(const Curve& curve, const std::string& style, int shape, const PlotText& words) {
    const std::size_t count = columns_of(curve).count;
    const std::size_t stride = (count + kMostMarks - 1) / kMostMarks;
    for (std::size_t k = 0; k < count; k += std::max<std::size_t>(1, stride))
      drawing_.mark(style, shape, at(curve.x[k], curve.y[k]),
                    curve.name + ": " + figure(curve.y[k], 4) + " at " + words.x_label + " " + tick_label(curve.x[k]));
  }

 private:
  [[nodiscard]] Point at(double x, double y) const { return {area_.x(x_.share(x)), area_.y(y_.share(y))}; }

  Drawing& drawing_;
  const Area& area_;
  const Axis& x_;
  const Axis& y_;
};

// A fitted line takes the color of the measured curve before it.
std::vector<int> colors_of(const LinePlot& plot) {
  std::vector<int> colors;
  int next = 0;
  for (const Curve& curve : plot.curves) colors.push_back(curve.is_fitted && next > 0 ? next - 1 : next++);
  return colors;
}

}  // namespace

std::string svg(const LinePlot& plot, Placement placement) {
  std::vector<double> xs = all_x(plot);
  std::vector<double> ys = all_y(plot);
  const std::size_t points = ys.size();
  for (const CrossLine& line : plot.lines) (line.is_on_y ? ys : xs).push_back(line.at);
  const Axis x(plot.x_scale, xs, false);
  const Axis y(plot.y_scale, ys, plot.y_from_zero);
  const std::vector<int> colors = colors_of(plot);

  std::vector<LegendEntry> legend;
  for (std::size_t k = 0; k < plot.curves.size(); ++k) {
    const std::string number = color_of(colors[k]);
    if (plot.curves[k].is_fitted)
      legend.push_back({plot.curves[k].name, "fitted l" + number, LegendEntry::kLineOnly});
    else
      legend.push_back({plot.curves[k].name, mark_style(plot.curves[k], number), mark_of(colors[k])});
  }
  Drawing measured(kPlotWidth, kPlotHeight, plot.text.title, {});
  const double taller = std::max(0.0, draw_head(measured, plot.text.title, legend) - kUsualHead);
  Drawing drawing(kPlotWidth, kPlotHeight + taller, plot.text.title, plot.text.description);
  Area area = area_below(draw_head(drawing, plot.text.title, legend), y);
  area.bottom += taller;
  draw_y_axis(drawing, area, y, plot.text.y_label);
  draw_x_axis(drawing, area, x, plot.text.x_label);

  Curves curves(drawing, area, x, y);
  for (std::size_t k = 0; k < plot.curves.size(); ++k)
    if (columns_of(plot.curves[k]).has_band) curves.band(plot.curves[k], "band b" + color_of(colors[k]));
  for (std::size_t k = 0; k < plot.curves.size(); ++k) {
    const Curve& curve = plot.curves[k];
    const std::string number = color_of(colors[k]);
    curves.line(curve, (curve.is_fitted || curve.is_hollow ? "fitted l" : "curve l") + number);
    if (!curve.is_fitted) curves.marks(curve, mark_style(curve, number), mark_of(colors[k]), plot.text);
  }
  draw_cross_lines(drawing, area, plot.lines, &x, y);
  const bool is_empty = std::none_of(ys.begin(), ys.begin() + static_cast<std::ptrdiff_t>(points),
                                     [&](double v) { return std::isfinite(y.share(v)); });
  if (is_empty) draw_absence(drawing, area);
  return drawing.finish(placement);
}

}  // namespace broadside::reports::plots

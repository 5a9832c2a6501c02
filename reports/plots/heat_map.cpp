#include "reports/plots/heat_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/figures.hpp"

namespace broadside::reports::plots {
namespace {

constexpr double kFaint = 0.06;      // the least value still gets a visible shade
constexpr double kTextTurns = 0.55;  // on darker cells the figure is written in the paper's color
constexpr double kCellGap = 1.5;
constexpr double kKeyWidth = 150.0;

double value_at(const HeatMap& map, std::size_t row, std::size_t column) {
  if (row >= map.values.size() || column >= map.values[row].size()) return std::numeric_limits<double>::quiet_NaN();
  return map.values[row][column];
}

struct Shades {
  double low = 0.0;
  double high = 1.0;
  bool is_log = false;

  [[nodiscard]] double of(double value) const {
    if (!(high > low)) return 0.5;
    const double share = is_log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
    return kFaint + (1.0 - kFaint) * std::clamp(share, 0.0, 1.0);
  }
};

Shades shades_of(const HeatMap& map) {
  Shades shades{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                map.shade_scale == Scale::kLog};
  for (std::size_t r = 0; r < map.rows.size(); ++r)
    for (std::size_t c = 0; c < map.columns.size(); ++c) {
      const double value = value_at(map, r, c);
      if (!std::isfinite(value) || (shades.is_log && value <= 0.0)) continue;
      shades.low = std::min(shades.low, value);
      shades.high = std::max(shades.high, value);
    }
  return shades;
}

void draw_key(Drawing& drawing, const HeatMap& map, const Shades& shades) {
  const double left = kPlotWidth - 18.0 - kKeyWidth;
  constexpr int kSteps = 12;
  const double width = kKeyWidth / kSteps;
  for (int k = 0; k < kSteps; ++k)
    drawing.shaded_rect("s0", {left + k * width, 30.0}, width, 8.0, kFaint + (1.0 - kFaint) * k / (kSteps - 1), "");
  drawing.text("tick", {left - 5.0, 38.0}, Anchor::kEnd, quantity(shades.low, map.unit, 2));
  drawing.text("tick", {left + kKeyWidth, 26.0}, Anchor::kEnd, quantity(shades.high, map.unit, 2));
}

}  // namespace

std::string svg(const HeatMap& map, Placement placement) {
  Drawing drawing(kPlotWidth, kPlotHeight, map.text.title, map.text.description);
  const double head = draw_head(drawing, map.text.title, {});
  double widest = 0.0;
  for (const std::string& row : map.rows) widest = std::max(widest, text_width(row));
  const Area area{32.0 + std::min(widest, 160.0), head + 12.0, kPlotWidth - 18.0, kPlotHeight - 44.0};
  draw_x_names(drawing, area, map.columns, map.text.x_label);
  drawing.upright_text("name", {15.0, 0.5 * (area.top + area.bottom)}, map.text.y_label);

  const Shades shades = shades_of(map);
  if (map.rows.empty() || map.columns.empty() || !(shades.low <= shades.high)) {
    draw_absence(drawing, area);
    return drawing.finish(placement);
  }
  draw_key(drawing, map, shades);
  const double width = (area.right - area.left) / static_cast<double>(map.columns.size());
  const double height = (area.bottom - area.top) / static_cast<double>(map.rows.size());
  for (std::size_t r = 0; r < map.rows.size(); ++r) {
    const double top = area.bottom - static_cast<double>(r + 1) * height;
    const double middle = top + 0.5 * height + 3.7;
    drawing.text("tick", {area.left - 6.0, middle}, Anchor::kEnd, map.rows[r]);
    for (std::size_t c = 0; c < map.columns.size(); ++c) {
      const double left = area.left + static_cast<double>(c) * width;
      const double value = value_at(map, r, c);
      const bool is_shown = std::isfinite(value) && (!shades.is_log || value > 0.0);
      const double shade = is_shown ? shades.of(value) : 0.0;
      const std::string words = std::isfinite(value) ? quantity(value, map.unit, 3) : "\xE2\x80\x93";
      drawing.shaded_rect("s0", {left, top}, width - kCellGap, height - kCellGap, shade,
                          map.text.y_label + " " + map.rows[r] + ", " + map.text.x_label + " " + map.columns[c] + ": " +
                              (std::isfinite(value) ? words : "absent"));
      drawing.text(shade > kTextTurns ? "on-full" : "value", {left + 0.5 * width, middle}, Anchor::kMiddle, words);
    }
  }
  return drawing.finish(placement);
}

}  // namespace broadside::reports::plots

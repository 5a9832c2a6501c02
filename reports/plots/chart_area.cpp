#include "reports/plots/chart_area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/escape.hpp"

namespace broadside::reports::plots {
namespace {

constexpr double kMargin = 12.0;
constexpr double kLegendLine = 17.0;
constexpr double kHeadingLine = 17.0;
constexpr double kHeadingWidth = 1.2;  // of a bold letter at 13 px, in widths of a label's letter

// The heading in as many lines as it needs; a single word that is too long is cut by the viewer.
std::vector<std::string> heading_lines(std::string_view title) {
  std::vector<std::string> lines{""};
  while (!title.empty()) {
    const std::size_t space = std::min(title.find(' '), title.size());
    const std::string word(title.substr(0, space));
    title.remove_prefix(std::min(space + 1, title.size()));
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || kHeadingWidth * text_width(longer) <= kPlotWidth - 2.0 * kMargin)
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

}  // namespace

double draw_head(Drawing& drawing, std::string_view title, const std::vector<LegendEntry>& legend) {
  double y = 22.0;
  for (const std::string& line : heading_lines(title)) {
    drawing.text("heading", {kMargin, y}, Anchor::kStart, line);
    y += kHeadingLine;
  }
  if (legend.empty()) return y - 5.0;
  double x = kMargin;
  y += 3.0;
  for (const LegendEntry& entry : legend) {
    const double taken = 22.0 + text_width(entry.name) + 14.0;
    if (x > kMargin && x + taken > kPlotWidth - kMargin) {
      x = kMargin;
      y += kLegendLine;
    }
    if (entry.mark == LegendEntry::kSwatch)
      drawing.rect(entry.style, {x + 2.0, y - 9.0}, 10.0, 10.0);
    else if (entry.mark == LegendEntry::kLineOnly)
      drawing.line(entry.style, {x, y - 4.0}, {x + 16.0, y - 4.0});
    else
      drawing.mark(entry.style, entry.mark, {x + 8.0, y - 4.0});
    drawing.text("name", {x + 20.0, y}, Anchor::kStart, entry.name);
    x += taken;
  }
  return y + 8.0;
}

Area area_below(double head, const Axis& y) {
  double widest = 0.0;
  for (const Tick& tick : y.ticks()) widest = std::max(widest, text_width(tick.label));
  return {kMargin + 20.0 + widest, head + 8.0, kPlotWidth - 18.0, kPlotHeight - 44.0};
}

void draw_y_axis(Drawing& drawing, const Area& area, const Axis& y, std::string_view label) {
  for (const Tick& tick : y.ticks()) {
    const double at = area.y(y.share(tick.value));
    drawing.line("grid", {area.left, at}, {area.right, at});
    drawing.text("tick", {area.left - 6.0, at + 3.7}, Anchor::kEnd, tick.label);
  }
  drawing.line("frame", {area.left, area.top}, {area.left, area.bottom});
  drawing.upright_text("name", {kMargin + 3.0, 0.5 * (area.top + area.bottom)}, label);
}

void draw_x_axis(Drawing& drawing, const Area& area, const Axis& x, std::string_view label) {
  double free_from = -1e9;  // labels that would overlap are left out; their grid lines stay
  for (const Tick& tick : x.ticks()) {
    const double at = area.x(x.share(tick.value));
    drawing.line("grid", {at, area.top}, {at, area.bottom});
    const double half = 0.5 * text_width(tick.label);
    if (at - half < free_from) continue;
    drawing.text("tick", {at, area.bottom + 15.0}, Anchor::kMiddle, tick.label);
    free_from = at + half + 4.0;
  }
  drawing.line("frame", {area.left, area.bottom}, {area.right, area.bottom});
  drawing.text("name", {0.5 * (area.left + area.right), area.bottom + 33.0}, Anchor::kMiddle, label);
}

void draw_x_names(Drawing& drawing, const Area& area, const std::vector<std::string>& names, std::string_view label) {
  drawing.line("frame", {area.left, area.bottom}, {area.right, area.bottom});
  drawing.text("name", {0.5 * (area.left + area.right), area.bottom + 33.0}, Anchor::kMiddle, label);
  if (names.empty()) return;
  const double part = 1.0 / static_cast<double>(names.size());
  const auto columns =
      static_cast<std::size_t>(std::max(3.0, std::floor(part * (area.right - area.left) / text_width("x") - 0.5)));
  for (std::size_t k = 0; k < names.size(); ++k)
    drawing.text("tick", {area.x((static_cast<double>(k) + 0.5) * part), area.bottom + 15.0}, Anchor::kMiddle,
                 clipped(printable(names[k]), columns));
}

void draw_cross_lines(Drawing& drawing, const Area& area, const std::vector<CrossLine>& lines, const Axis* x,
                      const Axis& y) {
  constexpr double kLine = 13.0;
  constexpr double kGap = 4.0;
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> free_from;  // of each line of words, from the top
  for (const CrossLine& line : lines) {
    const double share = line.is_on_y ? y.share(line.at) : x != nullptr ? x->share(line.at) : kNowhere;
    if (!(share >= 0.0 && share <= 1.0)) continue;
    if (line.is_on_y) {
      const double at = area.y(share);
      drawing.line("across", {area.left, at}, {area.right, at});
      drawing.text("across-name", {area.right - kGap, at - kGap}, Anchor::kEnd, line.text);
      continue;
    }
    const double at = area.x(share);
    drawing.line("across", {at, area.top}, {at, area.bottom});
    const double width = text_width(line.text);
    const bool is_left = at + kGap + width > area.right && at - kGap - width > area.left;
    const double start = is_left ? at - kGap - width : at + kGap;
    std::size_t row = 0;
    while (row < free_from.size() && start < free_from[row]) ++row;
    if (row == free_from.size()) free_from.push_back(start);
    free_from[row] = start + width + kGap;
    drawing.text("across-name", {is_left ? at - kGap : start, area.top + 11.0 + kLine * static_cast<double>(row)},
                 is_left ? Anchor::kEnd : Anchor::kStart, line.text);
  }
}

void draw_absence(Drawing& drawing, const Area& area) {
  drawing.text("name", {0.5 * (area.left + area.right), 0.5 * (area.top + area.bottom)}, Anchor::kMiddle, "no data");
}

}  // namespace broadside::reports::plots

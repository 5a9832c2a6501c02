#include "reports/plots/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/figures.hpp"

namespace broadside::reports::plots {

Bins bins_of(std::span<const double> values, std::uint32_t count, Scale scale) {
  Bins bins;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  const auto counts = [&](double value) { return std::isfinite(value) && (scale == Scale::kLinear || value > 0.0); };
  for (const double value : values) {
    if (!counts(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (!(low <= high) || count == 0) return bins;
  if (low == high) {  // only one value: a bin around it
    const double room = low == 0.0 ? 0.5 : 0.05 * std::abs(low);
    low -= room;
    high += room;
  }
  for (std::uint32_t k = 0; k <= count; ++k) {
    const double share = static_cast<double>(k) / count;
    bins.edges.push_back(scale == Scale::kLinear ? low + share * (high - low) : low * std::pow(high / low, share));
  }
  bins.edges.back() = high;
  bins.counts.assign(count, 0);
  for (const double value : values) {
    if (!counts(value)) continue;
    const auto above = std::upper_bound(bins.edges.begin(), bins.edges.end(), value);
    const auto bin = std::clamp<std::ptrdiff_t>(above - bins.edges.begin() - 1, 0, count - 1);
    ++bins.counts[static_cast<std::size_t>(bin)];
  }
  return bins;
}

std::string svg(const Histogram& histogram, Placement placement) {
  const Bins& bins = histogram.bins;
  const std::vector<double> heights(bins.counts.begin(), bins.counts.end());
  const Axis x(histogram.x_scale, bins.edges, false);
  const Axis y(Scale::kLinear, heights, true);
  Drawing drawing(kPlotWidth, kPlotHeight, histogram.text.title, histogram.text.description);
  const Area area = area_below(draw_head(drawing, histogram.text.title, {}), y);
  draw_y_axis(drawing, area, y, histogram.text.y_label);
  draw_x_axis(drawing, area, x, histogram.text.x_label);
  for (std::size_t k = 0; k < bins.counts.size() && k + 1 < bins.edges.size(); ++k) {
    const double left = area.x(x.share(bins.edges[k]));
    const double right = area.x(x.share(bins.edges[k + 1]));
    const double head = area.y(y.share(heights[k]));
    if (!std::isfinite(left) || !std::isfinite(right)) continue;
    drawing.rect("s0", {left, head}, std::max(0.5, right - left - 1.0), area.bottom - head,
                 figure(bins.edges[k], 4) + " to " + figure(bins.edges[k + 1], 4) + ": " + counted(bins.counts[k]));
  }
  if (bins.counts.empty()) draw_absence(drawing, area);
  return drawing.finish(placement);
}

}  // namespace broadside::reports::plots

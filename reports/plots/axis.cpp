#include "reports/plots/axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "reports/figures.hpp"

namespace broadside::reports::plots {
namespace {

constexpr double kLinearTicks = 6.0;
constexpr double kFewDecades = 2.5;   // below: 2 and 5 are ticks too
constexpr double kManyDecades = 8.5;  // above: every second decade

double round_step(double wanted) {
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= wanted * (1.0 - 1e-9)) return factor * decade;
  return 10.0 * decade;
}

}  // namespace

std::string tick_label(double value) {
  if (value >= 1e4 && value < 1e12 && value == std::floor(value)) return counted(static_cast<std::uint64_t>(value));
  return figure(value, 6);
}

Axis::Axis(Scale scale, std::span<const double> values, bool from_zero) : scale_(scale) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : values) {
    if (!std::isfinite(value) || (scale == Scale::kLog && value <= 0.0)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const bool has_none = !(low <= high);
  if (scale == Scale::kLog) {
    make_log(has_none ? 1.0 : low, has_none ? 10.0 : high);
  } else {
    if (has_none) low = 0.0, high = 1.0;
    if (from_zero) low = std::min(low, 0.0), high = std::max(high, 0.0);
    make_linear(low, high);
  }
}

void Axis::make_linear(double low, double high) {
  // One value alone still needs an axis with room on both sides.
  if (high - low <= 1e-12 * std::max(std::abs(low), std::abs(high))) {
    const double room = low == 0.0 ? 1.0 : std::abs(low) * 0.5;
    if (low != 0.0 || high != 0.0) low -= room;
    high += room;
  }
  const double step = round_step((high - low) / kLinearTicks);
  const double first = std::floor(low / step + 1e-9);
  const auto steps = static_cast<int>(std::ceil(high / step - 1e-9) - first);
  low_ = first * step;
  high_ = (first + steps) * step;
  for (int k = 0; k <= steps; ++k) {
    // Computed from the decimal step, so that a tick is what its digits say: 0.3 and not 0.30000000000000004.
    const double exact = (first + k) * step;
    const double value = std::stod(figure(exact, 12) == "0" ? "0" : figure(exact, 12));
    ticks_.push_back({value, tick_label(value)});
  }
}

void Axis::make_log(double low, double high) {
  if (low == high) low /= 1.5, high *= 1.5;
  const auto first = static_cast<int>(std::floor(std::log10(low)));
  const auto last = static_cast<int>(std::ceil(std::log10(high)));
  const double decades = std::log10(high / low);
  const int stride = decades > kManyDecades ? static_cast<int>(std::ceil(decades / kManyDecades)) : 1;
  std::vector<double> values;
  for (int k = first; k <= last; k += stride)
    for (const double factor : {1.0, 2.0, 5.0})
      if (factor == 1.0 || decades < kFewDecades) values.push_back(factor * std::pow(10.0, k));
  // From the last tick at or below the data to the first at or above it.
  const auto above = std::upper_bound(values.begin(), values.end(), low * (1.0 + 1e-9));
  const auto begin = above == values.begin() ? above : above - 1;
  auto end = std::lower_bound(values.begin(), values.end(), high * (1.0 - 1e-9));
  if (end != values.end()) ++end;
  low_ = std::min(low, *begin);
  high_ = std::max(high, *(end - 1));
  for (auto it = begin; it != end; ++it) ticks_.push_back({*it, tick_label(*it)});
}

double Axis::share(double value) const {
  if (!std::isfinite(value)) return std::numeric_limits<double>::quiet_NaN();
  if (scale_ == Scale::kLinear) return (value - low_) / (high_ - low_);
  if (value <= 0.0) return std::numeric_limits<double>::quiet_NaN();
  return std::log(value / low_) / std::log(high_ / low_);
}

}  // namespace broadside::reports::plots

#include "reports/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace broadside::reports {

double quantile(std::span<const double> sorted, double p) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double rank = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Summary summarize(std::span<const double> values) {
  std::vector<double> sorted;
  sorted.reserve(values.size());
  for (const double value : values)
    if (std::isfinite(value)) sorted.push_back(value);
  std::sort(sorted.begin(), sorted.end());

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Summary s;
  s.count = sorted.size();
  s.not_finite = values.size() - sorted.size();
  s.min = quantile(sorted, 0.0);
  s.p5 = quantile(sorted, 0.05);
  s.q1 = quantile(sorted, 0.25);
  s.median = quantile(sorted, 0.5);
  s.q3 = quantile(sorted, 0.75);
  s.p95 = quantile(sorted, 0.95);
  s.max = quantile(sorted, 1.0);

  double sum = 0.0;
  for (const double value : sorted) sum += value;
  s.mean = sum / static_cast<double>(sorted.size());  // 0/0 = NaN, as promised
  double squares = 0.0;
  for (const double value : sorted) squares += (value - s.mean) * (value - s.mean);
  s.deviation = sorted.size() < 2 ? kInfinity : std::sqrt(squares / static_cast<double>(sorted.size() - 1));
  s.relative_spread = sorted.size() < 2 ? kInfinity : (s.q3 - s.q1) / s.median;
  return s;
}

}  // namespace broadside::reports

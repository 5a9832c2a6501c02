// Summaries of many measurements: median, quartiles, tails, spread. Values that are left out are counted.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace broadside::reports {

// Computed from the finite values. Quantiles interpolate linearly between order statistics (Hyndman and Fan 1996,
// definition 7). All figures are NaN when there is no finite value.
struct Summary {
  std::uint64_t count = 0;       // finite values
  std::uint64_t not_finite = 0;  // NaN or infinite ones, left out
  double min = 0.0, p5 = 0.0, q1 = 0.0, median = 0.0, q3 = 0.0, p95 = 0.0, max = 0.0;
  double mean = 0.0;
  // Sample standard deviation (n - 1); infinite with fewer than two values, so that a single measurement does not
  // look exact.
  double deviation = 0.0;
  // (q3 - q1) / median; infinite with fewer than two values. It uses quartiles so that a few frames that the machine
  // interrupted do not decide it; the tails p5 and p95 are reported too.
  double relative_spread = 0.0;
};

Summary summarize(std::span<const double> values);

// Of values that are sorted and finite; 0 <= p <= 1. NaN when there are none.
double quantile(std::span<const double> sorted, double p);

}  // namespace broadside::reports

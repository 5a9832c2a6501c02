#include "reports/change_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace broadside::reports {
namespace {

// std::lgamma writes the sign to a global variable; here the sign is always positive, so it is not needed.
double log_gamma(double v) {
  int sign = 0;
  return lgamma_r(v, &sign);
}

// The regularized incomplete beta function by its continued fraction (Abramowitz and Stegun 26.5.8), evaluated by
// Lentz's method; it converges fast for x < (a + 1) / (a + b + 2), and the other side follows by symmetry.
double incomplete_beta(double a, double b, double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  if (x > (a + 1.0) / (a + b + 2.0)) return 1.0 - incomplete_beta(b, a, 1.0 - x);
  constexpr double kTiny = 1e-300;
  constexpr int kMostTerms = 10'000;
  const auto away_from_zero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1.0;
  double d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  for (int m = 1; m < kMostTerms; ++m) {
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    double factor = 1.0;
    for (const double term : {even, odd}) {
      d = 1.0 / away_from_zero(1.0 + term * d);
      c = away_from_zero(1.0 + term / c);
      factor = c * d;
      fraction *= factor;
    }
    if (std::abs(factor - 1.0) < std::numeric_limits<double>::epsilon()) break;
  }
  const double log_front = log_gamma(a + b) - log_gamma(a) - log_gamma(b) + a * std::log(x) + b * std::log1p(-x);
  return std::exp(log_front) * fraction / a;
}

struct Moments {
  double mean = 0.0;
  double variance = 0.0;  // of the sample, n - 1
};

Moments moments(std::span<const double> values) {
  Moments m;
  for (const double v : values) m.mean += v;
  m.mean /= static_cast<double>(values.size());
  for (const double v : values) m.variance += (v - m.mean) * (v - m.mean);
  m.variance /= static_cast<double>(values.size() - 1);
  return m;
}

// The split with the largest scaled energy distance of both sides, each of at least `least` values; 0 = there is none.
std::size_t best_split(std::span<const double> x, std::size_t least) {
  const std::size_t n = x.size();
  if (n < 2 * least) return 0;
  // Sums of |x_i - x_k| within the left side, within the right side and across; updated as values move to the left side
  // one by one.
  double within_left = 0.0;
  double within_right = 0.0;
  double across = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k) within_right += std::abs(x[i] - x[k]);
  double best = 0.0;
  std::size_t at = 0;
  for (std::size_t tau = 1; tau < n; ++tau) {
    const double moved = x[tau - 1];
    double to_left = 0.0;
    double to_right = 0.0;
    for (std::size_t i = 0; i + 1 < tau; ++i) to_left += std::abs(x[i] - moved);
    for (std::size_t k = tau; k < n; ++k) to_right += std::abs(x[k] - moved);
    within_left += to_left;
    within_right -= to_right;
    across += to_right - to_left;
    if (tau < least || n - tau < least) continue;
    const auto m = static_cast<double>(tau);
    const auto r = static_cast<double>(n - tau);
    double energy = 2.0 / (m * r) * across;
    if (tau > 1) energy -= 2.0 / (m * (m - 1.0)) * within_left;
    if (n - tau > 1) energy -= 2.0 / (r * (r - 1.0)) * within_right;
    const double q = m * r / (m + r) * energy;
    if (q > best) {
      best = q;
      at = tau;
    }
  }
  return at;
}

void split(std::span<const double> values, std::size_t first, std::size_t last, const ChangePointOptions& options,
           std::vector<std::size_t>& found) {
  const std::span<const double> part = values.subspan(first, last - first);
  const std::size_t at = best_split(part, options.least_values);
  if (at == 0 || welch_p(part.first(at), part.subspan(at)) > options.most_p) return;
  split(values, first, first + at, options, found);
  found.push_back(first + at);
  split(values, first + at, last, options, found);
}

ChangePoint between(std::span<const double> values, std::size_t first, std::size_t at, std::size_t last) {
  const std::span<const double> before = values.subspan(first, at - first);
  const std::span<const double> after = values.subspan(at, last - at);
  return {at, moments(before).mean, moments(after).mean, welch_p(before, after)};
}

}  // namespace

double student_two_sided(double t, double degrees) {
  return incomplete_beta(degrees / 2.0, 0.5, degrees / (degrees + t * t));
}

double welch_p(std::span<const double> a, std::span<const double> b) {
  if (a.size() < 2 || b.size() < 2) return 1.0;
  const Moments ma = moments(a);
  const Moments mb = moments(b);
  const double va = ma.variance / static_cast<double>(a.size());
  const double vb = mb.variance / static_cast<double>(b.size());
  if (!(va + vb > 0.0)) return ma.mean == mb.mean ? 1.0 : 0.0;
  const double t = std::abs(ma.mean - mb.mean) / std::sqrt(va + vb);
  const double degrees = (va + vb) * (va + vb) /
                         (va * va / static_cast<double>(a.size() - 1) + vb * vb / static_cast<double>(b.size() - 1));
  return student_two_sided(t, degrees);
}

std::vector<ChangePoint> change_points(std::span<const double> values, const ChangePointOptions& options) {
  std::vector<std::size_t> found;
  split(values, 0, values.size(), options, found);
  for (;;) {
    std::vector<ChangePoint> points;
    for (std::size_t k = 0; k < found.size(); ++k)
      points.push_back(
          between(values, k == 0 ? 0 : found[k - 1], found[k], k + 1 == found.size() ? values.size() : found[k + 1]));
    const auto weakest = std::max_element(points.begin(), points.end(),
                                          [](const ChangePoint& a, const ChangePoint& b) { return a.p < b.p; });
    if (weakest == points.end() || weakest->p <= options.most_p) return points;
    found.erase(found.begin() + (weakest - points.begin()));
  }
}

}  // namespace broadside::reports

#include "bench/paper/cost_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/pair.hpp"
#include "reports/statistics.hpp"

namespace broadside::bench::paper {
namespace {

constexpr int kResamples = 2000;  // enough that 50 of them lie in the 2.5 % tail
constexpr double kTail = 0.025;
constexpr std::size_t kTerms = 3;

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

struct Points {
  std::vector<double> counts;
  std::vector<double> means;
};

Points points_of(const CostCurve& curve) {
  Points points;
  for (std::size_t k = 0; k < curve.counts.size() && k < curve.seconds.size(); ++k) {
    if (curve.seconds[k].empty()) continue;
    points.counts.push_back(curve.counts[k]);
    points.means.push_back(mean_of(curve.seconds[k]));
  }
  return points;
}

// Solves the normal equations of the chosen terms by elimination with pivots. Columns are scaled to size 1, because N^2
// and 1 lie ten decades apart. False when they are dependent.
bool solve(const std::vector<std::array<double, kTerms>>& rows, const std::vector<std::size_t>& chosen,
           std::array<double, kTerms>& answer) {
  const std::size_t n = chosen.size();
  std::array<double, kTerms> scale{};
  for (std::size_t c = 0; c < n; ++c) {
    for (const auto& row : rows) scale[c] += row[chosen[c]] * row[chosen[c]];
    scale[c] = std::sqrt(scale[c]);
    if (!(scale[c] > 0.0)) return false;
  }
  std::array<std::array<double, kTerms + 1>, kTerms> m{};
  for (const auto& row : rows)
    for (std::size_t i = 0; i < n; ++i) {
      const double left = row[chosen[i]] / scale[i];
      for (std::size_t j = 0; j < n; ++j) m[i][j] += left * row[chosen[j]] / scale[j];
      m[i][n] += left;  // every relative time is 1
    }
  for (std::size_t p = 0; p < n; ++p) {
    std::size_t best = p;
    for (std::size_t i = p + 1; i < n; ++i)
      if (std::abs(m[i][p]) > std::abs(m[best][p])) best = i;
    if (std::abs(m[best][p]) < 1e-12) return false;
    std::swap(m[p], m[best]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == p) continue;
      const double factor = m[i][p] / m[p][p];
      for (std::size_t j = p; j <= n; ++j) m[i][j] -= factor * m[p][j];
    }
  }
  answer = {};
  for (std::size_t c = 0; c < n; ++c) answer[chosen[c]] = m[c][n] / m[c][c] / scale[c];
  return true;
}

// The count at which the straight line through log ratios is zero; nothing when it does not change sign from - to +.
struct Change {
  double count = 0.0;
  bool is_upward = false;
};
std::optional<Change> change_between(double count0, double ratio0, double count1, double ratio1) {
  const double low = std::log(ratio0);
  const double high = std::log(ratio1);
  if (!std::isfinite(low) || !std::isfinite(high) || low == high || (low < 0.0) == (high < 0.0)) return std::nullopt;
  const double share = low / (low - high);
  return Change{std::exp(std::log(count0) + share * std::log(count1 / count0)), high > low};
}

// Draws from a fixed sequence: the state counts up, and splitmix64 hashes it.
class Draws {
 public:
  double resampled_mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) sum += values[core::splitmix64(state_++) % values.size()];
    return sum / static_cast<double>(values.size());
  }

 private:
  std::uint64_t state_ = 0;
};

// Interval of the crossing between two counts, by resampling the runs of both methods at both.
void add_interval(Crossover& crossover, double count0, double count1,
                  const std::array<const std::vector<double>*, 4>& t) {
  if (std::any_of(t.begin(), t.end(), [](const auto* values) { return values->size() < 2; })) return;
  Draws draws;
  std::vector<double> found;
  for (int k = 0; k < kResamples; ++k) {
    const double ratio0 = draws.resampled_mean(*t[0]) / draws.resampled_mean(*t[1]);
    const double ratio1 = draws.resampled_mean(*t[2]) / draws.resampled_mean(*t[3]);
    if (const auto change = change_between(count0, ratio0, count1, ratio1)) found.push_back(change->count);
  }
  crossover.share = static_cast<double>(found.size()) / kResamples;
  if (found.empty()) return;
  std::sort(found.begin(), found.end());
  crossover.low = reports::quantile(found, kTail);
  crossover.high = reports::quantile(found, 1.0 - kTail);
}

void add_crossovers(const CostCurve& a, const CostCurve& b, std::vector<Crossover>& all) {
  struct Common {
    double count;
    const std::vector<double>* a;
    const std::vector<double>* b;
  };
  std::vector<Common> common;
  for (std::size_t i = 0; i < a.counts.size(); ++i)
    for (std::size_t j = 0; j < b.counts.size(); ++j)
      if (a.counts[i] == b.counts[j] && !a.seconds[i].empty() && !b.seconds[j].empty())
        common.push_back({a.counts[i], &a.seconds[i], &b.seconds[j]});
  for (std::size_t k = 0; k + 1 < common.size(); ++k) {
    const Common &p = common[k], &q = common[k + 1];
    const auto change = change_between(p.count, mean_of(*p.a) / mean_of(*p.b), q.count, mean_of(*q.a) / mean_of(*q.b));
    if (!change) continue;
    // The ratio a / b rises through 1, so a was the cheaper method below this count.
    Crossover crossover{change->is_upward ? a.method : b.method,
                        change->is_upward ? b.method : a.method,
                        change->count,
                        std::nullopt,
                        std::nullopt,
                        0.0};
    add_interval(crossover, p.count, q.count, {p.a, p.b, q.a, q.b});
    all.push_back(std::move(crossover));
  }
}

}  // namespace

std::optional<CostFit> fit_cost(const CostCurve& curve) {
  const Points points = points_of(curve);
  if (points.counts.size() < kTerms) return std::nullopt;
  std::vector<std::array<double, kTerms>> rows;
  for (std::size_t k = 0; k < points.counts.size(); ++k) {
    const double n = points.counts[k];
    rows.push_back({1.0 / points.means[k], n / points.means[k], n * n / points.means[k]});
  }
  // With three terms every subset can be tried: the best one without a negative term is the constrained optimum.
  std::optional<CostFit> best;
  double best_error = std::numeric_limits<double>::infinity();
  for (unsigned mask = 1; mask < 8; ++mask) {
    std::vector<std::size_t> chosen;
    for (std::size_t c = 0; c < kTerms; ++c)
      if ((mask >> c & 1U) != 0) chosen.push_back(c);
    std::array<double, kTerms> x{};
    if (!solve(rows, chosen, x) || *std::min_element(x.begin(), x.end()) < 0.0) continue;
    CostFit fit{x[0], x[1], x[2], 0.0, points.counts.size(), chosen.size(), points.counts.back()};
    double error = 0.0;
    for (std::size_t k = 0; k < points.counts.size(); ++k) {
      const double relative = fit.at(points.counts[k]) / points.means[k] - 1.0;
      error += relative * relative;
      fit.worst_relative_error = std::max(fit.worst_relative_error, std::abs(relative));
    }
    // A further term is taken only when it lowers the error by more than rounding.
    if (error < best_error - 1e-12) best_error = error, best = fit;
  }
  return best;
}

std::optional<double> effective_depth(const CostFit& brute, const CostFit& pruned) {
  constexpr double kLeastShare = 0.1;
  if (brute.quadratic_share() < kLeastShare || pruned.quadratic_share() < kLeastShare) return std::nullopt;
  return std::log(brute.quadratic_s / pruned.quadratic_s) / std::log(8.0);
}

std::vector<Crossover> crossovers(std::span<const CostCurve> curves) {
  std::vector<Crossover> all;
  for (std::size_t a = 0; a < curves.size(); ++a)
    for (std::size_t b = a + 1; b < curves.size(); ++b) add_crossovers(curves[a], curves[b], all);
  return all;
}

}  // namespace broadside::bench::paper

// How cost grows with the number of bodies: a fitted model, and where one method overtakes another.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace broadside::bench::paper {

// Seconds per frame of one method at rising counts, one value per run.
struct CostCurve {
  std::string method;
  std::vector<double> counts;
  std::vector<std::vector<double>> seconds;  // [count][run]; empty where it was not measured
};

// t(N) = fixed + linear N + quadratic N^2, each >= 0: the published model O(N + N^2 / 8^L), with the constants that O()
// leaves out. Fitted by least squares of relative errors, because times span decades.
struct CostFit {
  double fixed_s = 0.0;
  double linear_s = 0.0;
  double quadratic_s = 0.0;
  double worst_relative_error = 0.0;  // over the fitted counts
  std::size_t points = 0;
  std::size_t terms = 0;       // terms in use; with as many points as terms the fit is exact and proves nothing
  double largest_count = 0.0;  // that was measured

  [[nodiscard]] double at(double count) const { return fixed_s + count * (linear_s + count * quadratic_s); }
  [[nodiscard]] bool is_tested() const { return points > terms; }
  // Which part of the cost at the largest count comes from the quadratic term?
  [[nodiscard]] double quadratic_share() const {
    return quadratic_s * largest_count * largest_count / at(largest_count);
  }
};

// Nothing with fewer than three measured counts: three unknowns.
std::optional<CostFit> fit_cost(const CostCurve& curve);

// The L for which the published model explains the quadratic terms of a brute-force method and of one that prunes:
// quadratic(brute) / quadratic(pruned) = 8^L. Nothing where the term is less than a tenth of either cost at its largest
// count, because the fit is noise there.
std::optional<double> effective_depth(const CostFit& brute, const CostFit& pruned);

// The count at which `late` becomes cheaper than `early`, which is the cheaper one below it.
struct Crossover {
  std::string early;
  std::string late;
  double count = 0.0;
  // 95 % percentile bootstrap over runs; absent with fewer than two runs.
  std::optional<double> low;
  std::optional<double> high;
  double share = 0.0;  // of the resampled curves that cross at all
};

// All crossings between consecutive counts at which both methods were measured, by straight lines in log-log. The same
// input gives the same interval, because the draws are fixed.
std::vector<Crossover> crossovers(std::span<const CostCurve> curves);

}  // namespace broadside::bench::paper

#include "reports/ratio_interval.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/pair.hpp"
#include "reports/statistics.hpp"

namespace broadside::reports {
namespace {

constexpr std::size_t kResamples = 10'000;  // enough that 250 of them lie in the 2.5 % tail
constexpr double kTail = 0.025;             // for all looks together

// Draws from a fixed sequence: the state counts up, and splitmix64 hashes it.
class Draws {
 public:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(core::splitmix64(state_++) % n); }

 private:
  std::uint64_t state_ = 0;
};

double median_in_place(std::vector<double>& values) {
  const std::size_t upper = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(upper);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

// The median of processes, as they are or drawn with replacement.
class Side {
 public:
  explicit Side(const std::vector<ProcessRuns>& processes) : processes_(processes) {}

  double estimate() {
    figures_.clear();
    for (const ProcessRuns& runs : processes_) {
      scratch_ = runs;
      figures_.push_back(median_in_place(scratch_));
    }
    return median_in_place(figures_);
  }

  double draw(Draws& draws) {
    figures_.clear();
    for (std::size_t k = 0; k < processes_.size(); ++k) {
      const ProcessRuns& runs = processes_[draws.below(processes_.size())];
      scratch_.resize(runs.size());
      for (double& value : scratch_) value = runs[draws.below(runs.size())];
      figures_.push_back(median_in_place(scratch_));
    }
    return median_in_place(figures_);
  }

 private:
  const std::vector<ProcessRuns>& processes_;
  std::vector<double> scratch_;
  std::vector<double> figures_;
};

// least_p: the smallest p that this number of processes can give.
RatioInterval interval_of(double estimate, std::vector<double> resamples, double delta, std::uint32_t looks,
                          double least_p) {
  const double tail = kTail / looks;
  RatioInterval result{.estimate = estimate};
  std::sort(resamples.begin(), resamples.end());
  result.low = quantile(resamples, tail);
  result.high = quantile(resamples, 1.0 - tail);
  // The share of resamples that show no difference; one is added to the count, so that no p is zero.
  const auto share = [&](std::ptrdiff_t against) {
    return std::max((1.0 + static_cast<double>(against)) / (1.0 + static_cast<double>(kResamples)), least_p);
  };
  result.p_slower = share(std::upper_bound(resamples.begin(), resamples.end(), 1.0 + delta) - resamples.begin());
  result.p_faster = share(resamples.end() - std::lower_bound(resamples.begin(), resamples.end(), 1.0 / (1.0 + delta)));
  return result;
}

}  // namespace

double smallest_p(std::uint64_t base, std::uint64_t head, bool is_paired) {
  if (is_paired) return std::pow(0.5, static_cast<double>(base));
  double orders = 1.0;  // C(base + head, base), grown factor by factor
  for (std::uint64_t k = 1; k <= base && orders < 1e12; ++k)
    orders *= static_cast<double>(head + k) / static_cast<double>(k);
  return 1.0 / orders;
}

RatioInterval ratio_interval(const std::vector<ProcessRuns>& base, const std::vector<ProcessRuns>& head, double delta,
                             std::uint32_t looks) {
  Side base_side(base);
  Side head_side(head);
  Draws draws;
  std::vector<double> ratios(kResamples);
  for (double& ratio : ratios) {
    const double of_head = head_side.draw(draws);
    ratio = of_head / base_side.draw(draws);
  }
  return interval_of(head_side.estimate() / base_side.estimate(), std::move(ratios), delta, looks,
                     smallest_p(base.size(), head.size(), false));
}

RatioInterval paired_interval(const std::vector<ProcessRuns>& pairs, double delta, std::uint32_t looks) {
  Side side(pairs);
  Draws draws;
  std::vector<double> ratios(kResamples);
  for (double& ratio : ratios) ratio = side.draw(draws);
  return interval_of(side.estimate(), std::move(ratios), delta, looks, smallest_p(pairs.size(), pairs.size(), true));
}

std::vector<bool> benjamini_hochberg(const std::vector<double>& p_values, double q) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::size_t believed = 0;
  for (std::size_t k = 0; k < order.size(); ++k)
    if (p_values[order[k]] <= q * static_cast<double>(k + 1) / static_cast<double>(order.size())) believed = k + 1;
  std::vector<bool> is_believed(p_values.size(), false);
  for (std::size_t k = 0; k < believed; ++k) is_believed[order[k]] = true;
  return is_believed;
}

}  // namespace broadside::reports

#include "reports/ratio_interval.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/pair.hpp"
#include "reports/statistics.hpp"

namespace broadside::reports {
namespace {

constexpr std::size_t kResamples = 10'000;  // enough that the 2.5 % tail rests on 250 of them
constexpr double kTail = 0.025;             // of all looks together

// Deterministic draws: the state walks, splitmix64 scrambles it.
class Draws {
 public:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(core::splitmix64(state_++) % n); }

 private:
  std::uint64_t state_ = 0;
};

double median_of(std::vector<double>& values) {
  const std::size_t upper = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(upper);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

class Resampler {
 public:
  Resampler(const std::vector<ProcessRuns>& base, const std::vector<ProcessRuns>& head, bool is_paired)
      : base_(base), head_(head), is_paired_(is_paired) {}

  double estimate() {
    return combined([](const ProcessRuns& runs, std::vector<double>& into) { into = runs; },
                    [](std::size_t, std::size_t k) { return k; });
  }

  double draw() {
    const auto runs_of = [&](const ProcessRuns& runs, std::vector<double>& into) {
      into.resize(runs.size());
      for (double& value : into) value = runs[draws_.below(runs.size())];
    };
    return combined(runs_of, [&](std::size_t n, std::size_t) { return draws_.below(n); });
  }

 private:
  template <typename Runs, typename Process>
  double combined(Runs&& runs_of, Process&& process) {
    const auto figure = [&](const ProcessRuns& runs) {
      runs_of(runs, scratch_);
      return median_of(scratch_);
    };
    figures_.clear();
    if (is_paired_) {
      for (std::size_t k = 0; k < base_.size(); ++k) {
        const std::size_t pair = process(base_.size(), k);
        const double of_head = figure(head_[pair]);
        figures_.push_back(of_head / figure(base_[pair]));
      }
      return median_of(figures_);
    }
    for (std::size_t k = 0; k < head_.size(); ++k) figures_.push_back(figure(head_[process(head_.size(), k)]));
    const double of_head = median_of(figures_);
    figures_.clear();
    for (std::size_t k = 0; k < base_.size(); ++k) figures_.push_back(figure(base_[process(base_.size(), k)]));
    return of_head / median_of(figures_);
  }

  const std::vector<ProcessRuns>& base_;
  const std::vector<ProcessRuns>& head_;
  bool is_paired_;
  Draws draws_;
  std::vector<double> scratch_;
  std::vector<double> figures_;
};

}  // namespace

double smallest_p(std::uint64_t base, std::uint64_t head, bool is_paired) {
  if (is_paired) return std::pow(0.5, static_cast<double>(base));
  double orders = 1.0;  // C(base + head, base), grown factor by factor
  for (std::uint64_t k = 1; k <= base && orders < 1e12; ++k)
    orders *= static_cast<double>(head + k) / static_cast<double>(k);
  return 1.0 / orders;
}

RatioInterval ratio_interval(const std::vector<ProcessRuns>& base, const std::vector<ProcessRuns>& head, bool is_paired,
                             double delta, std::uint32_t looks) {
  const double tail = kTail / looks;
  Resampler resampler(base, head, is_paired);
  RatioInterval result{.estimate = resampler.estimate()};
  std::vector<double> ratios(kResamples);
  for (double& ratio : ratios) ratio = resampler.draw();
  std::sort(ratios.begin(), ratios.end());
  result.low = quantile(ratios, tail);
  result.high = quantile(ratios, 1.0 - tail);
  // Of the resamples, those that do not speak for a difference; one more, so that no p is zero.
  const auto share = [&](std::ptrdiff_t against) {
    return std::max((1.0 + static_cast<double>(against)) / (1.0 + static_cast<double>(kResamples)),
                    smallest_p(base.size(), head.size(), is_paired));
  };
  result.p_slower = share(std::upper_bound(ratios.begin(), ratios.end(), 1.0 + delta) - ratios.begin());
  result.p_faster = share(ratios.end() - std::lower_bound(ratios.begin(), ratios.end(), 1.0 / (1.0 + delta)));
  return result;
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

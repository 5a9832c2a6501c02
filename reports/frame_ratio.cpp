#include "reports/frame_ratio.hpp"

#include <algorithm>

#include "reports/statistics.hpp"

namespace broadside::reports {
namespace {

constexpr std::size_t kMostParts = 8;
constexpr std::size_t kFramesOfPart = 8;  // the fewest: a median of so many ignores one disturbed frame in three

double median_of(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return quantile(values, 0.5);
}

}  // namespace

double frame_ratio(const std::vector<double>& base, const std::vector<double>& head) {
  const std::size_t frames = base.size();
  const std::size_t parts = std::clamp<std::size_t>(frames / kFramesOfPart, 1, kMostParts);
  double base_s = 0.0;
  double head_s = 0.0;
  for (std::size_t part = 0; part < parts; ++part) {
    std::vector<double> seconds;
    std::vector<double> ratios;
    for (std::size_t k = part * frames / parts; k < (part + 1) * frames / parts; ++k) {
      if (!(base[k] > 0.0)) continue;  // the clock is too coarse for this frame
      seconds.push_back(base[k]);
      ratios.push_back(head[k] / base[k]);
    }
    if (ratios.empty()) continue;
    const double part_s = median_of(seconds) * static_cast<double>(seconds.size());
    base_s += part_s;
    head_s += part_s * median_of(ratios);
  }
  return base_s > 0.0 ? head_s / base_s : 1.0;
}

}  // namespace broadside::reports

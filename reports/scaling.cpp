#include "reports/scaling.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "reports/change_points.hpp"
#include "reports/timing.hpp"

namespace broadside::reports {
namespace {

struct Member {
  std::string family;
  std::uint64_t count = 0;
};

// Splits "freefall:bunny:50" into freefall:bunny and 50; a name without a count belongs to no family.
Member member_of(const std::string& scene) {
  const std::size_t colon = scene.rfind(':');
  Member member;
  if (colon == std::string::npos) return member;
  const char* end = scene.data() + scene.size();
  if (std::from_chars(scene.data() + colon + 1, end, member.count).ptr != end || member.count == 0) return {};
  member.family = scene.substr(0, colon);
  return member;
}

// The t that is exceeded, on either side, with a probability of 5 %; found by bisection.
double student_95(double degrees) {
  double low = 0.0;
  double high = 1000.0;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (student_two_sided(middle, degrees) > 0.05 ? low : high) = middle;
  }
  return low;
}

}  // namespace

PowerLaw fit_power_law(const std::vector<double>& n, const std::vector<double>& seconds) {
  const auto count = static_cast<double>(n.size());
  double x_mean = 0.0;
  double y_mean = 0.0;
  for (std::size_t k = 0; k < n.size(); ++k) {
    x_mean += std::log(n[k]) / count;
    y_mean += std::log(seconds[k]) / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t k = 0; k < n.size(); ++k) {
    xx += (std::log(n[k]) - x_mean) * (std::log(n[k]) - x_mean);
    xy += (std::log(n[k]) - x_mean) * (std::log(seconds[k]) - y_mean);
  }
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  PowerLaw law{xy / xx, kNan, kNan};
  if (n.size() < 3) return law;
  double residual = 0.0;
  for (std::size_t k = 0; k < n.size(); ++k) {
    const double off = std::log(seconds[k]) - y_mean - law.exponent * (std::log(n[k]) - x_mean);
    residual += off * off;
  }
  const double reach = student_95(count - 2.0) * std::sqrt(residual / (count - 2.0) / xx);
  law.low = law.exponent - reach;
  law.high = law.exponent + reach;
  return law;
}

std::vector<ScalingSeries> scaling_series(const core::RunRows& rows) {
  std::map<std::pair<std::string, std::string>, std::map<std::uint64_t, Summary>> families;
  for (const Timing& timing : pool_samples(rows)) {
    const Member member = member_of(timing.stamp.scene_name);
    if (member.count == 0 || !timing.admission.is_admitted || !(timing.frame.median > 0.0)) continue;
    families[{member.family, timing.stamp.label()}].emplace(member.count, timing.frame);
  }
  std::vector<ScalingSeries> all;
  for (const auto& [key, counts] : families) {
    if (counts.size() < 2) continue;
    ScalingSeries series{.family = key.first, .label = key.second};
    for (const auto& [count, frame] : counts) {
      series.n.push_back(static_cast<double>(count));
      series.seconds.push_back(frame.median);
      series.p5.push_back(frame.p5);
      series.p95.push_back(frame.p95);
    }
    series.law = fit_power_law(series.n, series.seconds);
    all.push_back(std::move(series));
  }
  return all;
}

}  // namespace broadside::reports

#include "reports/time_ratio.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/pair.hpp"
#include "reports/admission.hpp"
#include "reports/figures.hpp"
#include "reports/statistics.hpp"

namespace broadside::reports {
namespace {

constexpr int kResamples = 10'000;  // enough that the 2.5 % tail rests on 250 of them
constexpr double kTail = 0.025;

// The median frame of each run of one (scene, label), and what decides whether two such sets may be compared.
struct Runs {
  std::vector<double> median_frame_s;
  core::Stamp stamp;
  std::size_t frames = 0;
  std::string refusal;  // of the first sample that was not admitted
};

using Key = std::pair<std::string, std::string>;  // scene name, label

std::vector<double> frame_seconds(const core::Sample& sample) {
  std::vector<double> sum;
  for (const core::StageSeries& series : sample.stages) {
    if (series.stage == "frame") return series.seconds;
    sum.resize(std::max(sum.size(), series.seconds.size()), 0.0);
    for (std::size_t k = 0; k < series.seconds.size(); ++k) sum[k] += series.seconds[k];
  }
  return sum;
}

std::map<Key, Runs> runs_of(const core::RunRows& rows) {
  std::map<Key, Runs> all;
  for (const core::Sample& sample : rows.samples) {
    Runs& runs = all[{sample.stamp.scene_name, sample.stamp.label()}];
    const Admission admission = admit(sample, rows);
    const std::vector<double> seconds = frame_seconds(sample);
    const Summary frame = summarize(seconds);
    if (runs.refusal.empty() && !admission.is_admitted) runs.refusal = admission.reason;
    if (runs.refusal.empty() && (frame.count == 0 || frame.not_finite > 0)) runs.refusal = "a run has no usable times";
    if (runs.refusal.empty() && !runs.median_frame_s.empty() && runs.frames != seconds.size())
      runs.refusal = "its runs differ in their number of frames";
    runs.stamp = sample.stamp;
    runs.frames = seconds.size();
    runs.median_frame_s.push_back(frame.median);
  }
  return all;
}

std::string why_not(const Runs* base, const Runs* head) {
  if (base == nullptr) return "the base has no time";
  if (head == nullptr) return "the head has no time";
  if (!base->refusal.empty()) return "the base's time is struck out: " + base->refusal;
  if (!head->refusal.empty()) return "the head's time is struck out: " + head->refusal;
  if (base->stamp.scene_digest != head->stamp.scene_digest) return "the scene is another one";
  if (base->stamp.machine != head->stamp.machine) return "the machine is another one";
  if (base->frames != head->frames)
    return "the runs have " + counted(base->frames) + " frames in the base and " + counted(head->frames) +
           " in the head";
  if (!enough_runs(base->median_frame_s.size(), head->median_frame_s.size()))
    return "too few runs to show a difference (" + counted(base->median_frame_s.size()) + " and " +
           counted(head->median_frame_s.size()) + "; 4 and 4 are enough)";
  return "";
}

// Deterministic draws: the state walks, splitmix64 scrambles it.
class Draws {
 public:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(core::splitmix64(state_++) % n); }

 private:
  std::uint64_t state_ = 0;
};

double median_of(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return quantile(values, 0.5);
}

double resampled_median(std::span<const double> values, Draws& draws, std::vector<double>& scratch) {
  scratch.resize(values.size());
  for (double& value : scratch) value = values[draws.below(values.size())];
  return median_of(scratch);
}

}  // namespace

bool enough_runs(std::uint64_t base, std::uint64_t head) {
  double orders = 1.0;  // C(base + head, base), grown factor by factor
  for (std::uint64_t k = 1; k <= base && orders * kTail <= 1.0; ++k)
    orders *= static_cast<double>(head + k) / static_cast<double>(k);
  return orders * kTail > 1.0;
}

Interval bootstrap_ratio(std::span<const double> base, std::span<const double> head) {
  std::vector<double> scratch(base.begin(), base.end());
  const double base_median = median_of(scratch);
  scratch.assign(head.begin(), head.end());
  const double head_median = median_of(scratch);

  Draws draws;
  std::vector<double> ratios(kResamples);
  for (double& ratio : ratios) {
    const double of_head = resampled_median(head, draws, scratch);
    ratio = of_head / resampled_median(base, draws, scratch);
  }
  std::sort(ratios.begin(), ratios.end());
  return {.estimate = head_median / base_median, .low = quantile(ratios, kTail), .high = quantile(ratios, 1.0 - kTail)};
}

std::vector<TimeRatio> time_ratios(const core::RunRows& base, const core::RunRows& head, double slack) {
  const std::map<Key, Runs> base_runs = runs_of(base);
  const std::map<Key, Runs> head_runs = runs_of(head);
  std::map<Key, std::pair<const Runs*, const Runs*>> both;
  for (const auto& [key, runs] : base_runs) both[key].first = &runs;
  for (const auto& [key, runs] : head_runs) both[key].second = &runs;

  std::vector<TimeRatio> ratios;
  for (const auto& [key, sides] : both) {
    const auto [old_runs, new_runs] = sides;
    const bool is_any_admitted =
        (old_runs != nullptr && old_runs->refusal.empty()) || (new_runs != nullptr && new_runs->refusal.empty());
    if (!is_any_admitted) continue;
    TimeRatio r{.scene = key.first, .label = key.second};
    if (old_runs != nullptr) r.base_runs = old_runs->median_frame_s.size();
    if (new_runs != nullptr) r.head_runs = new_runs->median_frame_s.size();
    r.reason = why_not(old_runs, new_runs);
    if (r.reason.empty()) {
      const Interval interval = bootstrap_ratio(old_runs->median_frame_s, new_runs->median_frame_s);
      r.ratio = interval.estimate;
      r.low = interval.low;
      r.high = interval.high;
      r.speed = r.low > 1.0 + slack    ? Speed::kSlower
                : r.high < 1.0 - slack ? Speed::kFaster
                                       : Speed::kNoDifferenceShown;
    }
    ratios.push_back(std::move(r));
  }
  return ratios;
}

}  // namespace broadside::reports

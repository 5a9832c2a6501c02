#include "reports/time_ratio.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "reports/admission.hpp"
#include "reports/figures.hpp"
#include "reports/frame_ratio.hpp"
#include "reports/ratio_interval.hpp"
#include "reports/sample_figures.hpp"
#include "reports/statistics.hpp"

namespace broadside::reports {
namespace {

constexpr double kFalseDiscoveries = 0.025;  // one-sided, as the tail of a 95 % interval

// The runs of one (scene, label), and the facts that decide whether two such sets may be compared.
struct Runs {
  std::map<std::uint64_t, std::vector<std::vector<double>>> by_process;  // run by run the seconds of its frames
  std::uint64_t count = 0;
  core::Stamp stamp;
  std::size_t frames = 0;
  std::string refusal;  // of the first sample that was not admitted

  // The median frame of each run.
  [[nodiscard]] std::vector<ProcessRuns> processes() const {
    std::vector<ProcessRuns> all;
    for (const auto& [process, runs] : by_process) {
      all.emplace_back();
      for (const std::vector<double>& seconds : runs) all.back().push_back(summarize(seconds).median);
    }
    return all;
  }
};

using Key = std::pair<std::string, std::string>;  // scene name, label

std::map<Key, Runs> runs_of(const core::RunRows& rows) {
  std::map<Key, Runs> all;
  for (const core::Sample& sample : rows.samples) {
    Runs& runs = all[{sample.stamp.scene_name, sample.stamp.label()}];
    const Admission admission = admit(sample, rows);
    std::vector<double> seconds = frame_seconds(sample);
    const Summary frame = summarize(seconds);
    if (runs.refusal.empty() && !admission.is_admitted) runs.refusal = admission.reason;
    if (runs.refusal.empty() && (frame.count == 0 || frame.not_finite > 0 || !(frame.median > 0.0)))
      runs.refusal = "a run has no usable times";
    if (runs.refusal.empty() && runs.count > 0 && runs.frames != seconds.size())
      runs.refusal = "its runs differ in their number of frames";
    runs.stamp = sample.stamp;
    runs.frames = seconds.size();
    runs.by_process[sample.process].push_back(std::move(seconds));
    ++runs.count;
  }
  return all;
}

std::string why_not(const Runs* base, const Runs* head) {
  if (base == nullptr) return "the base has no time";
  if (head == nullptr) return "the head has no time";
  if (!base->refusal.empty()) return "the base's time is struck out: " + base->refusal;
  if (!head->refusal.empty()) return "the head's time is struck out: " + head->refusal;
  if (base->stamp.scene_digest != head->stamp.scene_digest) return "the scenes differ";
  if (base->stamp.machine != head->stamp.machine) return "the machines differ";
  if (base->frames != head->frames)
    return "the runs have " + counted(base->frames) + " frames in the base and " + counted(head->frames) +
           " in the head";
  return "";
}

// Whether processes are compared in pairs: pairs have the same names on both sides and equally many runs, and only
// names that were recorded can pair. When there are too few pairs to show anything, the processes are compared
// separately, because that needs fewer.
bool is_paired(const Runs& base, const Runs& head) {
  return enough_processes(base.by_process.size(), head.by_process.size(), true) &&
         base.by_process.size() == head.by_process.size() && !base.by_process.contains(0) &&
         std::equal(
             base.by_process.begin(), base.by_process.end(), head.by_process.begin(),
             [](const auto& a, const auto& b) { return a.first == b.first && a.second.size() == b.second.size(); });
}

// Head over base, run by run, for each pair of processes.
std::vector<ProcessRuns> pairs_of(const Runs& base, const Runs& head) {
  std::vector<ProcessRuns> pairs;
  for (const auto& [process, runs] : base.by_process) {
    const std::vector<std::vector<double>>& of_head = head.by_process.at(process);
    pairs.emplace_back();
    for (std::size_t k = 0; k < runs.size(); ++k) pairs.back().push_back(frame_ratio(runs[k], of_head[k]));
  }
  return pairs;
}

// The ratio with its p-values. Which speed it means is decided later, over all cells together.
RatioInterval measure(const Runs& base, const Runs& head, double delta, std::uint32_t looks, TimeRatio& r) {
  r.is_paired = is_paired(base, head);
  const RatioInterval interval = r.is_paired ? paired_interval(pairs_of(base, head), delta, looks)
                                             : ratio_interval(base.processes(), head.processes(), delta, looks);
  r.ratio = interval.estimate;
  r.low = interval.low;
  r.high = interval.high;
  r.speed = Speed::kInconclusive;
  return interval;
}

void decide(TimeRatio& r, bool is_slower_believed, bool is_faster_believed, double delta) {
  if (!enough_processes(r.base_processes, r.head_processes, r.is_paired)) {
    r.reason = "too few processes to show a difference (" + counted(r.base_processes) + " and " +
               counted(r.head_processes) + "; 4 and 4 are enough, 10 and 10 are good)";
    return;
  }
  const bool is_above = r.low > 1.0 + delta;
  const bool is_below = r.high < 1.0 / (1.0 + delta);
  if (is_above && is_slower_believed)
    r.speed = Speed::kSlower;
  else if (is_below && is_faster_believed)
    r.speed = Speed::kFaster;
  else if (r.low >= 1.0 / (1.0 + delta) && r.high <= 1.0 + delta)
    r.speed = Speed::kSame;
  else
    r.reason = is_above || is_below ? "among so many cells, one may differ this much by chance"
                                    : "the interval contains the limit of " + percent(delta);
}

}  // namespace

bool enough_processes(std::uint64_t base, std::uint64_t head, bool is_paired) {
  return smallest_p(base, head, is_paired) < kFalseDiscoveries;
}

std::vector<TimeRatio> time_ratios(const core::RunRows& base, const core::RunRows& head, double delta,
                                   std::uint32_t looks) {
  const std::map<Key, Runs> base_runs = runs_of(base);
  const std::map<Key, Runs> head_runs = runs_of(head);
  std::map<Key, std::pair<const Runs*, const Runs*>> both;
  for (const auto& [key, runs] : base_runs) both[key].first = &runs;
  for (const auto& [key, runs] : head_runs) both[key].second = &runs;

  std::vector<TimeRatio> ratios;
  std::vector<std::size_t> measured;
  std::vector<double> p_slower;
  std::vector<double> p_faster;
  for (const auto& [key, sides] : both) {
    const auto [old_runs, new_runs] = sides;
    const bool is_any_admitted =
        (old_runs != nullptr && old_runs->refusal.empty()) || (new_runs != nullptr && new_runs->refusal.empty());
    if (!is_any_admitted) continue;
    TimeRatio r{.scene = key.first, .label = key.second};
    if (old_runs != nullptr) r.base_runs = old_runs->count, r.base_processes = old_runs->by_process.size();
    if (new_runs != nullptr) r.head_runs = new_runs->count, r.head_processes = new_runs->by_process.size();
    r.reason = why_not(old_runs, new_runs);
    if (r.reason.empty()) {
      const RatioInterval interval = measure(*old_runs, *new_runs, delta, looks, r);
      measured.push_back(ratios.size());
      p_slower.push_back(interval.p_slower);
      p_faster.push_back(interval.p_faster);
    }
    ratios.push_back(std::move(r));
  }
  const std::vector<bool> slower = benjamini_hochberg(p_slower, kFalseDiscoveries / looks);
  const std::vector<bool> faster = benjamini_hochberg(p_faster, kFalseDiscoveries / looks);
  for (std::size_t k = 0; k < measured.size(); ++k) decide(ratios[measured[k]], slower[k], faster[k], delta);
  return ratios;
}

}  // namespace broadside::reports

// How much slower or faster the same work became, and how sure that is.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/rows.hpp"

namespace broadside::reports {

enum class Speed { kSlower, kFaster, kNoDifferenceShown, kNotComparable };

struct TimeRatio {
  std::string scene;
  std::string label;
  Speed speed = Speed::kNotComparable;
  double ratio = 0.0;            // time per frame of the head over that of the base: 1.1 = a tenth slower
  double low = 0.0, high = 0.0;  // 95 % interval of the ratio
  std::uint64_t base_runs = 0, head_runs = 0;
  std::string reason;  // why not comparable; empty otherwise
};

struct Interval {
  double estimate = 0.0, low = 0.0, high = 0.0;
};

// Ratio of the medians of head and base with its percentile-bootstrap interval (Efron 1979) at 95 %. The units that are
// drawn again are whole runs, given here by one figure each: frames of one run are no independent sample, they are the
// same workload in the same order. Deterministic: the same figures give the same interval. Neither may be empty.
Interval bootstrap_ratio(std::span<const double> base, std::span<const double> head);

// Can so many runs show a difference at all? If the two builds were equal, every run of one would be slower than every
// run of the other by mere chance once in C(base + head, base) times; that must be rarer than the interval's 2.5 %
// tail. So four runs on each side are enough, and three are not.
bool enough_runs(std::uint64_t base, std::uint64_t head);

// One entry per (scene, label) that has an admitted time in the base or in the head. Slower when the whole interval
// lies above 1 + slack, faster when it lies below 1 - slack.
std::vector<TimeRatio> time_ratios(const core::RunRows& base, const core::RunRows& head, double slack);

}  // namespace broadside::reports

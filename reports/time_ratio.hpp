// How much slower or faster the same work became, and how certain that is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/rows.hpp"

namespace broadside::reports {

// kSame is a claim too: the whole interval lies within delta. Everything else is inconclusive, which is not a pass.
enum class Speed { kSlower, kFaster, kSame, kInconclusive, kNotComparable };

struct TimeRatio {
  std::string scene;
  std::string label;
  Speed speed = Speed::kNotComparable;
  double ratio = 0.0;            // time per frame of the head over that of the base: 1.1 = a tenth slower
  double low = 0.0, high = 0.0;  // 95 % interval of the ratio, for all looks together
  std::uint64_t base_runs = 0, head_runs = 0;
  std::uint64_t base_processes = 0, head_processes = 0;
  bool is_paired = false;  // the builds ran in turns, process beside process
  std::string reason;      // why not comparable or inconclusive; empty otherwise
};

// One entry per (scene, label) that has an admitted time in the base or in the head. A run counts by its median frame.
// Where both sides name the same processes, they ran in turns (core::Sample::process), and pairs are compared, frame by
// frame (frame_ratio). Slower when the whole interval lies above 1 + delta, faster when it lies below 1 / (1 + delta),
// and both only if the result survives Benjamini and Hochberg at 2.5 % over all entries, because among many cells some
// look slower by chance. looks: as for ratio_interval.
std::vector<TimeRatio> time_ratios(const core::RunRows& base, const core::RunRows& head, double delta,
                                   std::uint32_t looks = 1);

// Whether the process of each run is known, and both sides ran enough processes to show a difference.
bool enough_processes(std::uint64_t base, std::uint64_t head, bool is_paired);

}  // namespace broadside::reports

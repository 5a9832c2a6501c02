// Figures that several parts of a report take from samples.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/rows.hpp"
#include "reports/ratio_interval.hpp"

namespace broadside::reports {

// Seconds per frame: the stage "frame", or the sum of the stages where an engine gives none.
std::vector<double> frame_seconds(const core::Sample& sample);

// Median frame of each run of a stamp, by the process that ran it.
std::map<std::uint64_t, ProcessRuns> median_frames(const core::RunRows& rows, const core::Stamp& stamp);

// A stage's times along the frames, over all runs of a stamp. Frames are put into bins; each bin has the median, p10
// and p90 of its values from all runs. stage empty = the whole frame.
struct OverFrames {
  std::vector<double> frame;  // middle of each bin
  std::vector<double> median, p10, p90;
  std::uint64_t frames_per_bin = 1;
};
OverFrames over_frames(const core::RunRows& rows, const core::Stamp& stamp, const std::string& stage,
                       std::size_t most_bins);

}  // namespace broadside::reports

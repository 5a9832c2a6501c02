#include "reports/sample_figures.hpp"

#include <algorithm>
#include <cmath>

#include "reports/admission.hpp"
#include "reports/statistics.hpp"

namespace broadside::reports {
namespace {

std::vector<double> stage_seconds(const core::Sample& sample, const std::string& stage) {
  if (stage.empty()) return frame_seconds(sample);
  for (const core::StageSeries& series : sample.stages)
    if (series.stage == stage) return series.seconds;
  return {};
}

}  // namespace

std::vector<double> frame_seconds(const core::Sample& sample) {
  std::vector<double> sum;
  for (const core::StageSeries& series : sample.stages) {
    if (series.stage == "frame") return series.seconds;
    sum.resize(std::max(sum.size(), series.seconds.size()), 0.0);
    for (std::size_t k = 0; k < series.seconds.size(); ++k) sum[k] += series.seconds[k];
  }
  return sum;
}

std::map<std::uint64_t, ProcessRuns> median_frames(const core::RunRows& rows, const core::Stamp& stamp) {
  std::map<std::uint64_t, ProcessRuns> found;
  for (const core::Sample& sample : rows.samples) {
    if (!same_stamp(sample.stamp, stamp)) continue;
    const Summary frame = summarize(frame_seconds(sample));
    if (frame.count > 0 && frame.median > 0.0) found[sample.process].push_back(frame.median);
  }
  return found;
}

OverFrames over_frames(const core::RunRows& rows, const core::Stamp& stamp, const std::string& stage,
                       std::size_t most_bins) {
  std::vector<std::vector<double>> runs;
  std::size_t frames = 0;
  for (const core::Sample& sample : rows.samples) {
    if (!same_stamp(sample.stamp, stamp)) continue;
    runs.push_back(stage_seconds(sample, stage));
    frames = std::max(frames, runs.back().size());
  }
  OverFrames out;
  out.frames_per_bin = std::max<std::uint64_t>(1, (frames + most_bins - 1) / most_bins);
  const auto width = static_cast<std::size_t>(out.frames_per_bin);
  for (std::size_t first = 0; first < frames; first += width) {
    const std::size_t last = std::min(first + width, frames);
    std::vector<double> values;
    for (const std::vector<double>& run : runs)
      for (std::size_t k = first; k < std::min(last, run.size()); ++k)
        if (std::isfinite(run[k])) values.push_back(run[k]);
    if (values.empty()) continue;
    std::sort(values.begin(), values.end());
    out.frame.push_back(0.5 * static_cast<double>(first + last + 1));
    out.median.push_back(quantile(values, 0.5));
    out.p10.push_back(quantile(values, 0.1));
    out.p90.push_back(quantile(values, 0.9));
  }
  return out;
}

}  // namespace broadside::reports

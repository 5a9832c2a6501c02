#include "reports/timing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reports/sample_figures.hpp"

namespace broadside::reports {
namespace {

constexpr std::string_view kFrame = "frame";

struct Pool {
  Timing timing;
  std::vector<core::StageSeries> stages;
  std::vector<double> frame;
  std::vector<double> fps;
  std::uint64_t refused = 0;
};

void append(std::vector<double>& to, const std::vector<double>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

void add(Pool& pool, const core::Sample& sample, const core::RunRows& rows) {
  const Admission admission = admit(sample, rows);
  if (!admission.is_admitted && pool.refused++ == 0) pool.timing.admission = admission;
  if (pool.refused == 0) pool.timing.admission = admission;

  const core::StageSeries* whole = nullptr;
  for (const core::StageSeries& series : sample.stages) {
    if (series.stage == kFrame) {
      whole = &series;
      continue;
    }
    auto found = std::find_if(pool.stages.begin(), pool.stages.end(),
                              [&](const core::StageSeries& known) { return known.stage == series.stage; });
    if (found == pool.stages.end()) found = pool.stages.insert(found, {series.stage, {}});
    append(found->seconds, series.seconds);
  }
  const std::vector<double> frame = frame_seconds(sample);
  pool.timing.frame_is_sum = pool.timing.frame_is_sum || whole == nullptr;
  append(pool.frame, frame);
  const double total_s = std::accumulate(frame.begin(), frame.end(), 0.0);
  if (!frame.empty()) pool.fps.push_back(static_cast<double>(frame.size()) / total_s);
  ++pool.timing.repetitions;
  pool.timing.warm_up_frames = std::max<std::uint64_t>(pool.timing.warm_up_frames, sample.warm_up_frames);
}

Timing finish(Pool pool) {
  Timing timing = std::move(pool.timing);
  for (const core::StageSeries& series : pool.stages)
    timing.stages.push_back({series.stage, summarize(series.seconds)});
  timing.frame = summarize(pool.frame);
  timing.fps = summarize(pool.fps);
  if (pool.refused > 0 && pool.refused < timing.repetitions)
    timing.admission.reason +=
        " (" + std::to_string(pool.refused) + " of " + std::to_string(timing.repetitions) + " runs)";
  return timing;
}

}  // namespace

std::vector<Timing> pool_samples(const core::RunRows& rows) {
  std::vector<Pool> pools;
  for (const core::Sample& sample : rows.samples) {
    auto found = std::find_if(pools.begin(), pools.end(),
                              [&](const Pool& pool) { return same_stamp(pool.timing.stamp, sample.stamp); });
    if (found == pools.end()) {
      found = pools.insert(found, Pool{});
      found->timing.stamp = sample.stamp;
    }
    add(*found, sample, rows);
  }
  std::vector<Timing> timings;
  timings.reserve(pools.size());
  for (Pool& pool : pools) timings.push_back(finish(std::move(pool)));
  return timings;
}

}  // namespace broadside::reports

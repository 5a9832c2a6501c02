// Times along the frames of a scene, and engines beside each other with the ratio of their times.
#include <algorithm>
#include <cmath>

#include "reports/element.hpp"
#include "reports/escape.hpp"
#include "reports/figures.hpp"
#include "reports/html_sections.hpp"
#include "reports/sample_figures.hpp"
#include "reports/timing_groups.hpp"

namespace broadside::reports {
namespace {

constexpr std::size_t kBins = 120;           // more than a screen can tell apart
constexpr std::size_t kMostStageCharts = 3;  // per group; the others are in the table of stages

std::string series_name(const Timing& timing) {
  return timing.stamp.label() + (timing.admission.is_admitted ? "" : " (struck out)");
}

Chart fps_chart(const SceneView& scene, const TimingGroup& group, const core::RunRows& rows) {
  Chart chart{.title = "Frames per second over the run: " + group.work(),
              .x = {.name = "frame"},
              .y = {.name = "FPS", .is_log = true},
              .has_zoom = true};
  std::uint64_t per_bin = 1;
  for (const Timing* timing : group.timings) {
    const OverFrames t = over_frames(rows, timing->stamp, "", kBins);
    per_bin = std::max(per_bin, t.frames_per_bin);
    Series series{.name = series_name(*timing), .x = t.frame};
    for (std::size_t k = 0; k < t.frame.size(); ++k) {
      series.y.push_back(1.0 / t.median[k]);
      series.low.push_back(1.0 / t.p90[k]);
      series.high.push_back(1.0 / t.p10[k]);
    }
    chart.series.push_back(std::move(series));
  }
  chart.description = "Frames per second along the run of " + scene.name + ", for " +
                      counted(group.timings.size(), "engine") + ": the median of every " + counted(per_bin) +
                      " frames over all runs, in a band from the 10th to the 90th percentile.";
  return chart;
}

Chart stage_chart(const SceneView& scene, const Timing& timing, const core::RunRows& rows) {
  const TimeUnit unit = time_unit_for(timing.frame.median);
  Chart chart{.title = "Stages over the run: " + series_name(timing),
              .description = "Median time of each stage of " + timing.stamp.label() + " along the run of " +
                             scene.name + ", stacked.",
              .x = {.name = "frame"},
              .y = {.name = "time per frame", .unit = std::string(unit.name), .from_zero = true},
              .has_zoom = true};
  for (const StageTiming& stage : timing.stages) {
    const OverFrames t = over_frames(rows, timing.stamp, stage.stage, kBins);
    Series series{.name = stage.stage, .kind = SeriesKind::kArea, .x = t.frame};
    for (const double seconds : t.median) series.y.push_back(seconds * unit.per_second);
    chart.series.push_back(std::move(series));
  }
  return chart;
}

// The units of the bootstrap: processes, or, when all runs are of one process, its runs. Then the interval covers less,
// and the page says so.
std::vector<ProcessRuns> units_of(const core::RunRows& rows, const core::Stamp& stamp) {
  const auto processes = median_frames(rows, stamp);
  std::vector<ProcessRuns> units;
  if (processes.size() == 1)
    for (const double run : processes.begin()->second) units.push_back({run});
  else
    for (const auto& [process, runs] : processes) units.push_back(runs);
  return units;
}

}  // namespace

std::string over_frames_section(const SceneView& scene, PageParts& page) {
  std::string figures;
  for (const TimingGroup& group : groups_of(scene)) {
    figures += page.charts.figure(fps_chart(scene, group, page.rows));
    if (group.stages.size() < 2) continue;
    for (std::size_t k = 0; k < std::min(kMostStageCharts, group.timings.size()); ++k)
      figures += page.charts.figure(stage_chart(scene, *group.timings[k], page.rows));
  }
  if (figures.empty()) return "";
  return element("section", element("h3", "Times over the frames"), element("div.charts", figures));
}

std::string side_by_side_section(const SceneView& scene, PageParts& page) {
  std::string figures;
  for (const TimingGroup& group : groups_of(scene)) {
    if (group.timings.size() < 2) continue;
    const Timing& first = *group.timings.front();
    const std::vector<ProcessRuns> base = units_of(page.rows, first.stamp);
    if (base.empty()) continue;
    Chart chart{.title = "Time per frame relative to " + first.stamp.label() + ": " + group.work(),
                .x = {.name = "time relative to " + first.stamp.label(), .is_log = true},
                .y = {.name = "engine"}};
    Series series{.name = "ratio, 95 % interval", .kind = SeriesKind::kPoints};
    for (const Timing* timing : group.timings) {
      const std::vector<ProcessRuns> own = units_of(page.rows, timing->stamp);
      if (own.empty()) continue;
      const RatioInterval ratio = timing == &first ? RatioInterval{1.0, 1.0, 1.0} : ratio_interval(base, own, 0.0);
      series.x.push_back(ratio.estimate);
      series.y.push_back(static_cast<double>(chart.y.categories.size()));
      series.low.push_back(ratio.low);
      series.high.push_back(ratio.high);
      chart.y.categories.push_back(series_name(*timing));
    }
    chart.description = "Median time per frame of each engine on " + scene.name + " over that of " +
                        first.stamp.label() +
                        ", with the 95 percent interval from resampled runs; left of 1 is faster.";
    chart.series.push_back(std::move(series));
    chart.marks.push_back({"equal", 1.0, false});
    figures += page.charts.figure(std::move(chart));
  }
  if (figures.empty()) return "";
  return element("section", element("h3", "Engines side by side"),
                 element("p.hint",
                         "Ratio of median frame times; whiskers span 95 % of resampled processes and runs. Runs of "
                         "one process differ less than runs of different processes would. Left of 1 is faster."),
                 element("div.charts", figures));
}

}  // namespace broadside::reports

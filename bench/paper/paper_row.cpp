#include "bench/paper/paper_row.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace broadside::bench::paper {

double PaperRun::seconds() const {
  return std::accumulate(window_s.begin(), window_s.end(), 0.0);
}

std::size_t PaperRow::window_count() const {
  return static_cast<std::size_t>((frames + window_frames - 1) / window_frames);
}

std::uint64_t PaperRow::frames_in(std::size_t window) const {
  return std::min(window_frames, frames - window * window_frames);
}

std::vector<double> PaperRow::fps() const {
  std::vector<double> values;
  for (const PaperRun& run : runs) values.push_back(static_cast<double>(frames) / run.seconds());
  return values;
}

std::vector<double> PaperRow::window_fps(std::size_t window) const {
  std::vector<double> values;
  for (const PaperRun& run : runs)
    if (window < run.window_s.size()) values.push_back(static_cast<double>(frames_in(window)) / run.window_s[window]);
  return values;
}

std::vector<double> PaperRow::half_fps(bool is_early) const {
  std::vector<double> values;
  for (const PaperRun& run : runs) {
    double seconds = 0.0;
    std::uint64_t counted = 0;
    for (std::size_t w = 0; w < run.window_s.size(); ++w) {
      const bool ends_early = 2 * (w * window_frames + frames_in(w)) <= frames;
      if (ends_early != is_early) continue;
      seconds += run.window_s[w];
      counted += frames_in(w);
    }
    if (counted > 0) values.push_back(static_cast<double>(counted) / seconds);
  }
  return values;
}

std::vector<double> PaperRow::stage_seconds(const std::string& stage) const {
  std::vector<double> values;
  for (const PaperRun& run : runs)
    if (const auto found = run.stage_s.find(stage); found != run.stage_s.end()) values.push_back(found->second);
  return values;
}

Penetration pooled(const std::vector<core::PenetrationStatistics>& windows) {
  Penetration all;
  double depth_sum = 0.0;
  double above = 0.0;
  for (const core::PenetrationStatistics& w : windows) {
    if (w.body_contacts == 0) continue;
    const auto contacts = static_cast<double>(w.body_contacts);
    all.largest_m = all.contacts == 0 ? w.largest_depth_m : std::max(all.largest_m, w.largest_depth_m);
    all.contacts += w.body_contacts;
    depth_sum += contacts * w.mean_depth_m;
    above += contacts * w.share_above_slop;
  }
  if (all.contacts == 0) {
    all.mean_m = all.largest_m = all.share_above_slop = std::numeric_limits<double>::quiet_NaN();
    return all;
  }
  all.mean_m = depth_sum / static_cast<double>(all.contacts);
  all.share_above_slop = above / static_cast<double>(all.contacts);
  return all;
}

}  // namespace broadside::bench::paper

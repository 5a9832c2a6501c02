#include "bench/paper/beyond_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/paper/cost_model.hpp"
#include "bench/timing.hpp"

namespace broadside::bench::paper {
namespace {

bool is_beyond(const PaperCell& cell) {
  return std::find(cell.experiments.begin(), cell.experiments.end(), "beyond") != cell.experiments.end();
}

}  // namespace

std::string why_too_long(const PaperCell& cell, std::span<const PaperCell> campaign, const CellFiles& files,
                         std::uint32_t runs, double limit_s) {
  if (!is_beyond(cell)) return "";
  std::map<std::uint32_t, std::vector<double>> seconds;  // a frame, by count
  for (const PaperCell& other : campaign) {
    if (!is_beyond(other) || other.model != cell.model || other.method != cell.method || other.count >= cell.count)
      continue;
    const auto row = files.finished(other.id);
    if (row && row->has_times()) seconds[other.count] = row->stage_seconds("frame");
  }
  CostCurve curve{cell.method, {}, {}};
  for (auto& [count, runs_of_count] : seconds) {
    curve.counts.push_back(count);
    curve.seconds.push_back(std::move(runs_of_count));
  }
  const auto fit = fit_cost(curve);
  if (!fit) return "";
  const double frame_s = fit->at(cell.count);
  const double frames = static_cast<double>(cell.frames) * (1.0 + runs) + static_cast<double>(kWarmUpFrames);
  if (frame_s * frames <= limit_s) return "";
  return fmt::format(
      "left out: from {:.0f} to {:.0f} bodies its cost predicts {:.2g} s a frame, {:.0f} s in all, more than the limit "
      "of {:.0f} s",
      curve.counts.front(), curve.counts.back(), frame_s, frame_s * frames, limit_s);
}

}  // namespace broadside::bench::paper

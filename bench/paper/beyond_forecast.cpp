#include "bench/paper/beyond_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/paper/cost_model.hpp"

namespace broadside::bench::paper {
namespace {

bool is_beyond(const PaperCell& cell) {
  return std::find(cell.experiments.begin(), cell.experiments.end(), "beyond") != cell.experiments.end();
}

}  // namespace

std::string why_too_long(const PaperCell& cell, std::span<const PaperCell> campaign, const CellFiles& files,
                         double limit_s) {
  if (!is_beyond(cell)) return "";
  std::map<std::uint32_t, double> spent_s;  // by count
  for (const PaperCell& other : campaign) {
    if (!is_beyond(other) || other.model != cell.model || other.method != cell.method || other.count >= cell.count)
      continue;
    const auto row = files.finished(other.id);
    if (row && row->has_times() && row->spent_s > 0.0) spent_s[other.count] = row->spent_s;
  }
  CostCurve curve{cell.method, {}, {}};
  for (const auto& [count, seconds] : spent_s) {
    curve.counts.push_back(count);
    curve.seconds.push_back({seconds});
  }
  const auto fit = fit_cost(curve);
  if (!fit || fit->at(cell.count) <= limit_s) return "";
  return fmt::format(
      "left out: recording and timing it would take {:.0f} s by what {:.0f} to {:.0f} bodies took, more than "
      "the limit of {:.0f} s",
      fit->at(cell.count), curve.counts.front(), curve.counts.back(), limit_s);
}

}  // namespace broadside::bench::paper

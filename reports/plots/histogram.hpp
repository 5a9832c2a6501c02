// How many values fall into each bin.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reports/plots/chart_area.hpp"

namespace broadside::reports::plots {

struct Bins {
  std::vector<double> edges;  // rising, one more than counts; a bin holds its low edge, the last one its high edge too
  std::vector<std::uint64_t> counts;
};

// Equal bins (equal on a log scale) over the finite values; on a log scale those at or below zero are left out. Without
// any value there is no bin.
Bins bins_of(std::span<const double> values, std::uint32_t count, Scale scale = Scale::kLinear);

struct Histogram {
  PlotText text;
  Scale x_scale = Scale::kLinear;
  Bins bins;
};

std::string svg(const Histogram& histogram, Placement placement = Placement::kFile);

}  // namespace broadside::reports::plots

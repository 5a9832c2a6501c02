// Grouped bars with error bars: series beside each other in every group.
#pragma once

#include <string>
#include <vector>

#include "reports/plots/chart_area.hpp"

namespace broadside::reports::plots {

struct BarSeries {
  std::string name;
  std::vector<double> values;  // one per group; not finite = absent, which is written at the bar's place
  std::vector<double> errors;  // half the length of the error bar, one per group; empty or not finite = none
};

struct BarPlot {
  PlotText text;
  // On a log scale bars start at the axis's low end, so lengths do not compare; heights do.
  Scale y_scale = Scale::kLinear;
  std::vector<std::string> groups;
  std::vector<BarSeries> series;
  std::vector<CrossLine> lines = {};  // only those on y are drawn
};

std::string svg(const BarPlot& plot, Placement placement = Placement::kFile);

}  // namespace broadside::reports::plots

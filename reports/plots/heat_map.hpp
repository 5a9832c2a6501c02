// A value as a function of two parameters: cells are shaded by the value, with the figure in each.
#pragma once

#include <string>
#include <vector>

#include "reports/plots/chart_area.hpp"

namespace broadside::reports::plots {

struct HeatMap {
  PlotText text;
  std::string unit;                  // of the values; figures are printed with it: "m" gives "1.2 mm"
  std::vector<std::string> columns;  // along x
  std::vector<std::string> rows;     // along y, the first at the bottom
  // [row][column]; not finite = absent, printed as a dash.
  std::vector<std::vector<double>> values;
  Scale shade_scale = Scale::kLinear;  // linear: faint = the least value, full = the largest
};

std::string svg(const HeatMap& map, Placement placement = Placement::kFile);

}  // namespace broadside::reports::plots

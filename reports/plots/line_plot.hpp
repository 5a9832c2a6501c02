// Curves over a common x, with bands around them; on log axes too, with fitted lines.
#pragma once

#include <string>
#include <vector>

#include "reports/plots/chart_area.hpp"

namespace broadside::reports::plots {

struct Curve {
  std::string name;
  std::vector<double> x = {};
  std::vector<double> y = {};  // as many as x; what is not finite is a gap
  // The band: as many as x, or none. Around the curve, for instance mean -+ standard deviation.
  std::vector<double> low = {};
  std::vector<double> high = {};
  // A model's line: dashed, without marks, in the color of the curve before it.
  bool is_fitted = false;
  // Curves that count less than the others: dashed, with hollow marks, in a color of its own.
  bool is_hollow = false;
};

struct LinePlot {
  PlotText text;
  Scale x_scale = Scale::kLinear;
  Scale y_scale = Scale::kLinear;
  bool y_from_zero = true;  // on a linear scale
  std::vector<Curve> curves = {};
  std::vector<CrossLine> lines = {};
};

// Curves of unequal lengths are cut to the shortest of their columns.
std::string svg(const LinePlot& plot, Placement placement = Placement::kFile);

}  // namespace broadside::reports::plots

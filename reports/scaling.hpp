// How cost grows with the number of bodies: scenes of one family, and the exponent of the power law through them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/rows.hpp"

namespace broadside::reports {

// seconds = c * n^exponent, by least squares on the logarithms.
struct PowerLaw {
  double exponent = 0.0;
  double low = 0.0, high = 0.0;  // 95 % interval (Student's t); both NaN with two points, which any line passes
};

struct ScalingSeries {
  std::string family;  // the scene's name up to its count: "freefall:bunny"
  std::string label;
  std::vector<double> n;        // rising
  std::vector<double> seconds;  // median frame of the admitted runs
  std::vector<double> p5, p95;
  PowerLaw law;
};

// Scenes belong to one family when their names differ only in the whole number at their end. Only admitted times are
// used, and only families with two counts or more.
std::vector<ScalingSeries> scaling_series(const core::RunRows& rows);

// n and seconds are positive and of the same length, with at least two different n.
PowerLaw fit_power_law(const std::vector<double>& n, const std::vector<double>& seconds);

}  // namespace broadside::reports

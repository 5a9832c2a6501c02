// Figures of one run over its steps, for a chart with the step along x.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/stamp.hpp"

namespace broadside::reports {

struct FrameColumn {
  std::string name;            // "largest depth"
  std::vector<double> values;  // one per step
};

struct FrameSeries {
  core::Stamp stamp;
  std::string subject;  // what belongs on one chart: "penetration", "energy"
  std::string unit;     // of all columns
  std::vector<std::uint64_t> steps;
  std::vector<FrameColumn> columns;
};

}  // namespace broadside::reports

// Charts as SVG pictures: files for papers, and what a page shows where no script runs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "reports/chart.hpp"
#include "reports/plots/drawing.hpp"

namespace broadside::reports {

// By the plots of reports/plots. Areas are drawn as lines, and bars down the side as upright ones.
std::string chart_svg(const Chart& chart, plots::Placement placement);

// One file per chart, NAME.svg and NAME.csv, named by number and title; the folder is made.
core::Result<std::vector<std::filesystem::path>> write_charts(const std::vector<Chart>& charts,
                                                              const std::filesystem::path& folder);

}  // namespace broadside::reports

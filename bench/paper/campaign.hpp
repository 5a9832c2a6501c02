// All cells of a plan, scene after scene, with progress.
#pragma once

#include <vector>

#include "bench/paper/measure_group.hpp"
#include "bench/paper/paper_plan.hpp"
#include "bench/paper/paper_row.hpp"
#include "core/result.hpp"

namespace broadside::bench::paper {

// One row per cell of the plan, in order. Says on stderr, group by group, how far it is and how long the rest will
// take.
core::Result<std::vector<PaperRow>> run_campaign(const std::vector<PaperCell>& cells, const MeasureOptions& options);

}  // namespace broadside::bench::paper

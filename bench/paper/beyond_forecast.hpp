// Whether a cell beyond the paper is worth trying: a forecast of its time from its times at smaller counts.
#pragma once

#include <span>
#include <string>

#include "bench/paper/cell_files.hpp"
#include "bench/paper/paper_plan.hpp"

namespace broadside::bench::paper {

// Says why the cell is left out; empty when it is tried. The model a + b N + c N^2 (cost_model.hpp) is fitted to at
// least three finished cells of the same model and method at smaller counts, and must predict at most limit_s. Their
// times are wall times of recording and timing with all loads, because a broad phase with fast frames may take a minute
// to load. Empty for cells that are not part of 'beyond'.
std::string why_too_long(const PaperCell& cell, std::span<const PaperCell> campaign, const CellFiles& files,
                         double limit_s);

}  // namespace broadside::bench::paper

// Whether a cell beyond the paper is worth trying: what it cost at smaller counts says what it will cost.
#pragma once

#include <span>
#include <string>

#include "bench/paper/cell_files.hpp"
#include "bench/paper/paper_plan.hpp"

namespace broadside::bench::paper {

// Empty, or why the cell is left out: a + b N + c N^2 (cost_model.hpp) through what its model's and method's finished
// cells of smaller counts took, three at least, predicts more than limit_s. What they took is wall time of recording
// and timing, all loads included: a broad phase that is fast at a frame may take a minute to be loaded. Of cells that
// are not 'beyond' nothing is said.
std::string why_too_long(const PaperCell& cell, std::span<const PaperCell> campaign, const CellFiles& files,
                         double limit_s);

}  // namespace broadside::bench::paper

// Whether a cell beyond the paper is worth trying: what it cost at smaller counts says what it will cost.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "bench/paper/cell_files.hpp"
#include "bench/paper/paper_plan.hpp"

namespace broadside::bench::paper {

// Empty, or why the cell is left out: a + b N + c N^2 (cost_model.hpp) through its model's and method's finished cells
// of smaller counts, three at least, predicts more than limit_s for recording and timing it. Of cells that are not
// 'beyond' nothing is said.
std::string why_too_long(const PaperCell& cell, std::span<const PaperCell> campaign, const CellFiles& files,
                         std::uint32_t runs, double limit_s);

}  // namespace broadside::bench::paper

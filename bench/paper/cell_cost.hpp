// How long a cell will take: for the order of cells and the progress display, never for a result.
#pragma once

#include <cstdint>
#include <span>

#include "bench/paper/paper_plan.hpp"

namespace broadside::bench::paper {

// Seconds for recording, judging and all timed runs of a cell, with its share of making the scene. From a table that
// was measured on two cores of an EPYC without a GPU (on one H100 for the GPU's engines): another machine is faster or
// slower by about the same factor for all cells.
double expected_seconds(const PaperCell& cell, std::uint32_t runs);

// Groups of cells with smaller ranks are measured first: the cheap cells of the paper, then those beyond it by number
// of bodies, because the cost of a method at smaller counts decides whether it is tried at larger ones.
double rank_of(std::span<const PaperCell> group, std::uint32_t runs);

}  // namespace broadside::bench::paper

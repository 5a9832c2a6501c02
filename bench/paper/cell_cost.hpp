// How long a cell will take: for the order of cells and the progress display, never for a result.
#pragma once

#include <cstdint>
#include <span>

#include "bench/paper/paper_plan.hpp"

namespace broadside::bench::paper {

// Seconds for recording, judging and all timed runs of a cell, its part of loading the scene included. By a table
// measured on two cores of an EPYC without a GPU (or on one H100, for the GPU's engines): another machine is faster or
// slower by about one factor for all.
double expected_seconds(const PaperCell& cell, std::uint32_t runs);

// Groups of cells with smaller ranks are measured first: the cheap ones of the paper; then those beyond it by their
// number of bodies, because what a method cost at smaller counts decides whether it is tried at larger ones.
double rank_of(std::span<const PaperCell> group, std::uint32_t runs);

}  // namespace broadside::bench::paper

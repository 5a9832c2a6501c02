// How long a cell will take: for the order of a campaign's cells and the time that is told, never for a result.
#pragma once

#include <cstdint>

#include "bench/paper/paper_plan.hpp"

namespace broadside::bench::paper {

// Seconds for recording, judging and all timed runs of a cell, its part of loading the scene included. By a table
// measured on two cores of an EPYC without a GPU (or on one H100, for the GPU's engines): another machine is faster or
// slower by about one factor for all.
double expected_seconds(const PaperCell& cell, std::uint32_t runs);

}  // namespace broadside::bench::paper

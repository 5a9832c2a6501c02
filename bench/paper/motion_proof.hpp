// Proves that an engine moves bodies as forces do, for engines whose trace has no two consecutive steps.
#pragma once

#include <vector>

#include "bench/record/run_plan.hpp"
#include "core/result.hpp"
#include "core/stamp.hpp"
#include "core/verdict.hpp"

namespace broadside::bench::paper {

// Records every one of the first steps of the plan's scene with this engine, in a folder below the plan's, and judges
// them by the laws that tie motion to forces. Returns the verdicts of laws that had something to judge; none when the
// run failed or has another stamp.
core::Result<std::vector<core::Verdict>> verdicts_of_first_steps(const RunPlan& plan, const CellSpec& spec,
                                                                 const core::Stamp& stamp);

}  // namespace broadside::bench::paper

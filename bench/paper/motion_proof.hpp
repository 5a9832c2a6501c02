// The proof that an engine moves bodies as forces do, where its trace has no two steps in a row.
#pragma once

#include <vector>

#include "bench/record/run_plan.hpp"
#include "core/result.hpp"
#include "core/stamp.hpp"
#include "core/verdict.hpp"

namespace broadside::bench::paper {

// Records the first steps of the plan's scene with this engine, each of them, into a folder below the plan's, and
// judges them by the laws that tie motion to forces. Verdicts of laws that met something; none when the run did not
// come about or has another stamp.
core::Result<std::vector<core::Verdict>> verdicts_of_first_steps(const RunPlan& plan, const CellSpec& spec,
                                                                 const core::Stamp& stamp);

}  // namespace broadside::bench::paper

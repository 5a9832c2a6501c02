// The bytes that an engine holds, sampled over a run; they are compared with the published memory figures.
#pragma once

#include "bench/cell/cell_spec.hpp"
#include "bench/record/run_plan.hpp"
#include "core/result.hpp"

namespace broadside::bench::paper {

// The mean of the bytes in use at the end of every window, in one run of plan.frames steps, minus the bytes in use
// before the engine was made. Counts device memory for an engine on the GPU, this process's heap otherwise.
core::Result<double> memory_of_run(const RunPlan& plan, const CellSpec& spec, std::uint64_t window_frames);

// "device memory", "heap of the process".
const char* memory_kind(const CellSpec& spec);

}  // namespace broadside::bench::paper

// Times cells: the same work as recording, with recording off.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/record/run_plan.hpp"
#include "bench/timing/turns.hpp"
#include "core/result.hpp"
#include "core/sample.hpp"

namespace broadside::bench {

// One sample per cell and repetition. Repetitions of different cells alternate, so that a drift of the machine affects
// all alike. Each repetition starts from the loaded scene and runs all frames of the plan. Before the first repetition
// each cell runs some frames untimed on an instance of its own, so that memory, threads and code are warm. Zones of a
// simulating engine: its own stages, and "frame" = the whole step; where the engine runs ahead (and no other process
// takes turns with it), "frame" is the interval from the end of the step before to the end of this one. Zones of a
// broad phase: "update", "find", "filter" (its own, of raw pairs) and "frame" = their sum, over boxes baked from
// plan.folder's octree-cpu trace. Zone of a narrow phase: "measure", per sampled frame.
// The final digest is read after the clock stopped.
// A reference is timed in a child process, each repetition in a new one that warms up first. When the child dies or
// fails, its last words go to stderr and the cell has no samples. turns: the other side of a run in turns, frame by
// frame; a run in a child process counts as one frame.
core::Result<std::vector<core::Sample>> time_plan(const RunPlan& plan, std::uint32_t repetitions, Turns& turns);

// One run of one cell of the plan, without warm-up, for callers that keep each run when it ends. At most so many frames
// are run.
core::Result<core::Sample> time_run(const RunPlan& plan, const CellSpec& spec, std::uint64_t most_frames);

// How many frames a simulation or a broad phase runs untimed before its first timed run. First touches of memory and
// starts of threads end after some frames: only the first handful is measurably slower, by some ten per cent.
inline constexpr std::uint64_t kWarmUpFrames = 20;

}  // namespace broadside::bench

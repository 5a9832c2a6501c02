// One cell of a race of broad phases: its engine in this process, or what a child process answered for it.
#pragma once

#include <string>
#include <vector>

#include "bench/cell/cell_spec.hpp"
#include "bench/process/child.hpp"
#include "core/engine/engine.hpp"
#include "core/result.hpp"

namespace broadside::bench {

// Makes the cell's engine, which then has a broad_phase. Errors: it cannot run here, wrong settings, no broad phase.
core::Result<core::Engine> make_broad_phase_of(const CellSpec& cell);

// Whether the cell runs in a child process: other people's engines always, every engine where limits were asked for.
bool runs_apart(const CellSpec& cell, const ChildLimits& limits);

struct ChildAnswer {
  std::string output;   // the child's JSON; empty when it gave none
  std::string absent;   // why it gave none; empty when it did
  std::string verdict;  // then how it failed: "abort", "time-out", ... (class_of in bench/process/child.hpp)
  std::string repeat;   // the command that repeats the failure
};

// Runs `broadside ARGUMENTS --engine THE_CELL'S --set ... --json --in-process`. Errors: interrupted, and bad input that
// the child reports.
core::Result<ChildAnswer> ask_child(std::vector<std::string> arguments, const CellSpec& cell,
                                    const ChildLimits& limits);

}  // namespace broadside::bench

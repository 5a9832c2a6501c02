// One cell of a race of broad phases: its engine in this process, or what a child process answered for it.
#pragma once

#include <string>
#include <vector>

#include "bench/cell/cell_spec.hpp"
#include "bench/process/child.hpp"
#include "core/engine/engine.hpp"
#include "core/result.hpp"

namespace broadside::bench {

// The cell's engine, whose broad_phase is there. Errors: it cannot run here, wrong settings, it offers no broad phase.
core::Result<core::Engine> make_broad_phase_of(const CellSpec& cell);

// Other people's engines run in a child process, and every engine where limits are asked for.
bool runs_apart(const CellSpec& cell, const ChildLimits& limits);

struct ChildAnswer {
  std::string output;   // its JSON; empty when it gave none
  std::string absent;   // why it gave none; empty when it did
  std::string verdict;  // then: "abort", "time-out", ... (class_of in bench/process/child.hpp)
  std::string repeat;   // and the command that repeats it
};

// Runs `broadside ARGUMENTS --engine THE_CELL'S --set ... --json --in-process`. Errors: interrupted, and what the child
// calls bad input.
core::Result<ChildAnswer> ask_child(std::vector<std::string> arguments, const CellSpec& cell,
                                    const ChildLimits& limits);

}  // namespace broadside::bench

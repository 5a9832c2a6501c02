// Runs one of our engines on what a trace recorded, and compares the results.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "bench/cell/cell_spec.hpp"
#include "bench/forensics/trace_difference.hpp"
#include "core/result.hpp"
#include "core/trace/trace_reader.hpp"

namespace broadside::bench {

struct Replay {
  std::string capability;      // "dynamics", "broad" or "narrow": what was repeated
  std::string expectation;     // what had to agree, one sentence
  std::filesystem::path file;  // the engine's own trace
  TraceDifference difference;
  // Whether anything was judged. Nothing is judged in a simulation in which every body is touched at once.
  bool has_judged = true;
  std::string remark;  // what was left out, one sentence; empty when nothing was
};

// capability: "dynamics", "broad" or "narrow", or empty to choose. A simulation is run again, recorded boxes are given
// to a broad phase, and poses and measured pairs to a narrow phase. The engine's trace goes to `folder`. Errors: a
// trace or an engine that lacks what is asked for; an engine that fails.
core::Result<Replay> replay_trace(const std::filesystem::path& trace, const CellSpec& engine,
                                  const std::string& capability, const std::filesystem::path& folder);

}  // namespace broadside::bench

// Judges traces; check and demo share this part.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/energy_series.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"

namespace broadside::bench {

struct Matter {
  std::filesystem::path trace;
  std::filesystem::path baseline;  // empty = the trace alone
  // Skip laws that do not compare with the baseline, because the trace was already judged alone.
  bool only_against_baseline = false;
  std::vector<std::string> only;  // validators to run; empty = all
  // Filled with the energy ledger when the trace has the groups that it needs.
  core::EnergySeries* energy = nullptr;
};

core::Result<core::CellVerdicts> judge_matter(const Matter& matter);

// The exit code that these verdicts lead to.
core::Exit exit_of(const std::vector<core::CellVerdicts>& rows);

}  // namespace broadside::bench

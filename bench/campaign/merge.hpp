// The cells of a campaign as one result that report and compare read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench::campaign {

struct MergeSummary {
  std::uint32_t cells = 0;                        // of the manifest
  std::uint32_t missing = 0;                      // not finished: never started, broken off, or cancelled
  std::uint32_t failed = 0;                       // verdicts
  std::map<std::string, std::uint32_t> by_state;  // "recorded" -> 40, "crashed" -> 1
  std::vector<std::string> notable;               // a line for each cell that is missing, crashed or timed out
};

// Writes cells.json, verdicts.json and samples.json to `out`, with what the campaign's job adds. `out` may be the
// campaign's own folder; trace files stay where they are and are named relative to `out`. A cell that is not finished
// becomes a row that says so. Errors: cells of different builds; two results of one stamp whose digests differ (both
// are named); damaged rows.
core::Result<MergeSummary> merge_cells(const std::filesystem::path& folder, const std::filesystem::path& out);

}  // namespace broadside::bench::campaign

// Two builds in turns on one machine: what differs between days or drifts differs for both.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/rows.hpp"

namespace broadside::bench {

struct InterleavePlan {
  std::string base, head;  // the two programs
  std::vector<std::string> scenes;
  std::vector<std::string> engines;  // as --engine takes them
  bool allow_stand_in = false;
  std::uint64_t frames = 0;       // 0 = each scene's own
  std::uint32_t processes = 15;   // of each build; as many pairs
  std::uint32_t repetitions = 1;  // runs of one process
  std::filesystem::path folder;   // base/ and head/ in it get the rows of both
};

struct InterleavedRows {
  core::RunRows base, head;
};

// Each build records and judges every scene; then pairs of timed processes, one of each build, ABBA, so that neither
// build always comes second. The process of a sample is the number of its pair: reports::time_ratios compares pairs.
core::Result<InterleavedRows> run_interleaved(const InterleavePlan& plan);

// `processes` timed runs of one program, one after the other, gathered into one list: what one process cannot see, the
// spread between processes, is in it. The arguments are those of 'time' without --out.
core::Result<std::vector<core::Sample>> time_in_processes(const std::vector<std::string>& arguments,
                                                          std::uint32_t processes, const std::filesystem::path& folder);

}  // namespace broadside::bench

// Times two builds in turns on one machine, so that drift and differences between days affect both alike.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
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
  std::uint32_t processes = 15;   // of each build; there are as many pairs
  std::uint32_t most = 60;        // of each build, where the first ones do not decide; at least `processes`
  std::uint32_t repetitions = 1;  // runs of one process
  std::filesystem::path folder;   // base/ and head/ in it get the rows of both
};

struct InterleavedRows {
  core::RunRows base, head;
};

// How often run_interleaved asks `untold`: after `processes` pairs, and after every doubling up to
// `most`.
std::uint32_t looks_of(const InterleavePlan& plan);

// The names of the scenes that need more pairs.
using Untold = std::function<std::set<std::string>(const InterleavedRows&)>;

// Each build records and judges every scene. Then pairs of timed processes run, one of each build, in the order ABBA,
// so that neither build always comes second. The process of a sample is the number of its pair: reports::time_ratios
// compares pairs. Scenes that `untold` names get more pairs, up to `most`: on a noisy machine a comparison takes
// longer, but it still gives an answer.
core::Result<InterleavedRows> run_interleaved(const InterleavePlan& plan, const Untold& untold);

// `processes` timed runs of one program, one after the other, in one list, so that the list contains the spread between
// processes, which a single process cannot show. The arguments are those of 'time' without --out.
core::Result<std::vector<core::Sample>> time_in_processes(const std::vector<std::string>& arguments,
                                                          std::uint32_t processes, const std::filesystem::path& folder);

}  // namespace broadside::bench

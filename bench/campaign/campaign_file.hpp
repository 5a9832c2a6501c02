// A campaign file: the cells of a campaign, in TOML.
//
//   name = "nightly"                # letters, digits, - and _
//   scenes = ["freefall:cube:{n}", "randommove:bunny:{n}"]
//   engines = ["octree-cpu", "hash-cpu", "bullet-dbvt[deferred=on]"]
//   frames = 120                    # default: each scene's own
//   repetitions = 5                 # timed runs of a cell; default 0: record and judge only
//   processes = 10                  # timed processes of a cell, each with so many runs; default 1
//   against = "all-pairs"           # the baseline of verdicts, recorded beside each cell; default none
//   stand_in = true                 # default false
//   time_limit_s = 600              # of each part of a cell: recording, judging, timing
//   [vary]                          # every combination replaces {n} in scenes and engines
//   n = [50, 100]
//
// Or the keys of a job (bench/campaign/job.hpp), which plans its own cells: README.md has an example.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace broadside::bench::campaign {

// The largest values that a campaign file may ask for, and so that a manifest may hold.
inline constexpr std::uint32_t kMostFrames = 1'000'000'000;
inline constexpr std::uint32_t kMostRepetitions = 10'000;  // of a cell, and processes
inline constexpr double kLongestLimit_s = 1e7;             // of a part of a cell: 116 days

class Job;

// One cell after all {keys} are replaced.
struct CellWork {
  std::string scene;   // "freefall:cube:50"
  std::string engine;  // "bullet-dbvt[deferred=on]"
  std::uint32_t frames = 0;
  std::uint32_t repetitions = 0;  // 0 = not timed
  std::uint32_t processes = 1;    // each of them makes so many repetitions
  std::string against;            // the baseline of verdicts: an engine that is recorded beside this one; empty = none
  bool stand_in = false;
  double time_limit_s = 3600.0;

  friend bool operator==(const CellWork&, const CellWork&) = default;
};

struct CampaignFile {
  std::string name;
  std::vector<CellWork> cells;     // in the file's order: scenes outermost, then values, then engines; no cell twice
  std::shared_ptr<const Job> job;  // instead of cells
};

// Errors name file, line and key: unknown keys, wrong types, a {word} that [vary] lacks, a value that nothing uses.
core::Result<CampaignFile> read_campaign_file(const std::filesystem::path& file);

}  // namespace broadside::bench::campaign

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
// Or the paper's experiments, which bring scenes and engines of their own:
//
//   name = "paper"
//   paper = ["table5", "tableA1"]   # or ["all"]
//   engine = "octree-gpu"           # default: the best that runs where it is planned
//   limit_s = 60                    # of a cell of 'beyond'
//   frames, repetitions, stand_in   # default 3000, 5, false
//   [vary]
//   models = ["bunny"]              # default: the paper's four
//   counts = [50]                   # default: the paper's
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/paper/paper_request.hpp"
#include "core/result.hpp"

namespace broadside::bench::campaign {

// One cell after all {keys} are replaced.
struct CellWork {
  std::string scene;   // "freefall:cube:50"
  std::string engine;  // "bullet-dbvt[deferred=on]"
  std::uint32_t frames = 0;
  std::uint32_t repetitions = 0;  // 0 = not timed
  std::uint32_t processes = 1;    // that each make so many
  std::string against;            // the baseline of verdicts, an engine that is recorded beside; empty = none
  bool stand_in = false;
  double time_limit_s = 3600.0;

  friend bool operator==(const CellWork&, const CellWork&) = default;
};

struct CampaignFile {
  std::string name;
  std::vector<CellWork> cells;  // in the file's order: scenes outermost, then values, then engines; no cell twice
  std::optional<paper::PaperRequest> paper;  // instead of cells
};

// Errors name file, line and key: unknown keys, wrong types, a {word} that [vary] lacks, a value that nothing uses.
core::Result<CampaignFile> read_campaign_file(const std::filesystem::path& file);

}  // namespace broadside::bench::campaign

// One scene of the main job: its engines recorded, judged and timed into one folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/cell/scene_arguments.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"

namespace broadside::bench {

// A cell, and the labels of the baselines that it is compared with after it was judged alone.
struct PartRow {
  std::string cell;
  std::vector<std::string> against;
};

struct JobPart {
  SceneArguments scene;
  std::vector<PartRow> rows;
  std::string ledger_of;  // the cell whose energy ledger is kept; empty = none
  std::filesystem::path folder;
  std::uint32_t repetitions = 1;
};

// Leaves one trace per engine, cells.json, verdicts.json, samples.json and energy.json in the folder. Existing results
// of the same build and scene are reused; verdicts only where each trace is the one that was judged.
core::Result<core::RunRows> run_part(const JobPart& part);

// The labels of the rows whose engines are libraries or programs of others, which run in child processes.
core::Result<std::vector<std::string>> foreign_labels(const JobPart& part);

}  // namespace broadside::bench

// Records several cells of one scene, in an order in which each finds the traces that it needs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/cell/cell_request.hpp"
#include "bench/process/child.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"
#include "core/scene/scene.hpp"

namespace broadside::bench {

struct RunPlan {
  SceneArguments source;
  core::Scene scene;
  std::vector<CellSpec> cells;
  std::uint64_t frames = 0;
  core::RecordLevel level = core::RecordLevel::kFull;
  StepSelection selection;
  std::uint32_t narrow_every = 1;
  std::filesystem::path folder;
  // Take over complete traces of the same stamp and frames that are already in the folder.
  bool reuse = false;
  // Continue incomplete traces of the same stamp that are in the folder.
  bool resume = false;
  ChildLimits limits;  // limits of the child process of a reference
  // Time references in this process and not in a child; set in the child itself.
  bool times_here = false;
};

struct RunOutcome {
  std::vector<core::Cell> cells;
  std::uint64_t reused = 0;  // of them, recorded cells taken over from an earlier run
};

// Engines that do not simulate are driven by the first simulating cell with default settings of the pipeline. If the
// plan has none, octree-cpu is recorded first and becomes a cell too. References run in child processes. The folder's
// cells.json is updated after every cell, so a run that ends early still lists the cells that it has.
core::Result<RunOutcome> run_plan(const RunPlan& plan);

// Makes the folder, or says why it cannot be written. What is already in it stays.
core::Status prepare_folder(const std::filesystem::path& folder);

}  // namespace broadside::bench

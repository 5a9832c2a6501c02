// Measures the cells of one scene: records and judges each once, then times them in turns. Every run is kept when it
// ends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "bench/paper/paper_plan.hpp"
#include "bench/paper/paper_row.hpp"
#include "core/result.hpp"

namespace broadside::bench::paper {

struct MeasureOptions {
  std::filesystem::path folder;  // a campaign's: cells/ and work/ are made in it
  std::uint32_t runs = 5;
  bool allow_stand_in = false;
  bool keeps_traces = false;
  // Called after every recording and every run with the share of the group's work that is done, 0 to 1.
  std::function<void(double)> progress;
  // All cells of the campaign. For a cell of 'beyond', times at smaller counts predict its time; it is measured when
  // that is at most limit_s.
  std::span<const PaperCell> campaign = {};
  double limit_s = 0.0;
};

// One row per cell, in order; all cells have the same `turns`. A cell with a folder in cells/ is taken over. The others
// are measured, and each leaves such a folder, whole or not at all. A cell that this machine or program cannot run is a
// row that says why, not an error; the next call tries it again. An interrupt is an error of exit code 3; the next call
// takes over what was recorded and timed until then.
core::Result<std::vector<PaperRow>> measure_group(std::span<const PaperCell> cells, const MeasureOptions& options);

}  // namespace broadside::bench::paper

// The paper's experiments as a kind of job of a campaign:
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

#include <filesystem>
#include <span>
#include <vector>

#include "bench/campaign/job.hpp"
#include "bench/paper/paper_request.hpp"
#include "bench/paper/paper_row.hpp"
#include "core/result.hpp"

namespace broadside::bench::paper {

campaign::JobKind paper_job_kind();

// Groups are measured in this process, as measure_group says: first those that are expected to take the least time.
campaign::JobPointer paper_job(const PaperRequest& request);

// The request's cells with the ids that a manifest gave them. Error: the manifest has another number of cells.
core::Result<std::vector<PaperCell>> planned_cells(const PaperRequest& request,
                                                   std::span<const campaign::ManifestCell> cells);

// The rows of a campaign's cells, from any machine; a cell without a result is a row that says why.
std::vector<PaperRow> rows_of(std::span<const PaperCell> cells, const std::filesystem::path& folder);

}  // namespace broadside::bench::paper

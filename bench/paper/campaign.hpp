// A campaign of the paper's experiments from here: planned, done, and read back as rows.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/paper/paper_request.hpp"
#include "bench/paper/paper_row.hpp"
#include "core/result.hpp"

namespace broadside::bench::campaign {
struct Manifest;
}

namespace broadside::bench::paper {

// Plans the request into the folder, does what is missing there, and gives one row per cell of the plan, in order. Says
// on stderr, scene by scene, how far it is and how long the rest will take. An interrupt is an error of exit code 3.
core::Result<std::vector<PaperRow>> run_campaign(const PaperRequest& request, const std::filesystem::path& folder);

// The rows of a campaign's cells, whatever machine did them; a cell without a result is a row that says why.
core::Result<std::vector<PaperRow>> rows_of_campaign(const campaign::Manifest& manifest,
                                                     const std::filesystem::path& folder);

}  // namespace broadside::bench::paper

// A campaign of the paper's experiments from here: planned, done, and read back as rows.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/paper/paper_request.hpp"
#include "bench/paper/paper_row.hpp"
#include "core/result.hpp"

namespace broadside::bench::paper {

// Plans the request into the folder, does what is missing there, and gives one row per cell of the plan, in order. Says
// on stderr, scene by scene, how far it is and how long the rest will take. An interrupt is an error of exit code 3.
core::Result<std::vector<PaperRow>> run_campaign(const PaperRequest& request, const std::filesystem::path& folder);

}  // namespace broadside::bench::paper

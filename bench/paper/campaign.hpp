// Plans a campaign of the paper's experiments, runs it in this process, and reads it back as rows.
#pragma once

#include <filesystem>
#include <vector>

#include "bench/paper/paper_request.hpp"
#include "bench/paper/paper_row.hpp"
#include "core/result.hpp"

namespace broadside::bench::paper {

// Plans the request into the folder, runs the missing cells there, and gives one row per cell of the plan, in order.
// After each scene it prints to stderr the progress and the time left. An interrupt is an error of exit code 3.
core::Result<std::vector<PaperRow>> run_campaign(const PaperRequest& request, const std::filesystem::path& folder);

}  // namespace broadside::bench::paper

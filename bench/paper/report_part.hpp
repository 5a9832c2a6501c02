// The paper's tables and figures as a part of the report of a run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/result.hpp"
#include "reports/report.hpp"

namespace broadside::bench::paper {

// From rows that 'paper' or the merge of a campaign wrote, a rows.json or a folder that holds one, and nothing else but
// meshes; `id` is the part's. Empty where there is none; a damaged one is an error.
core::Result<std::optional<reports::GuestPart>> report_part(const std::filesystem::path& rows, const std::string& id);

}  // namespace broadside::bench::paper

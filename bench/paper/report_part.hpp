// The paper's tables and figures as a part of the report of a run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/result.hpp"
#include "reports/report.hpp"

namespace broadside::bench::paper {

// Made from the rows that 'paper' or the merge of a campaign wrote: a rows.json, or a folder that holds one. Figure A1
// needs the meshes too. `id` is the id of the part. Empty where there are no rows; damaged ones are an error.
core::Result<std::optional<reports::GuestPart>> report_part(const std::filesystem::path& rows, const std::string& id);

}  // namespace broadside::bench::paper

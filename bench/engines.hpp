// The one table of engines: those of gpu/, then those of reference/engines.inc.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "core/engine/engine.hpp"
#include "core/result.hpp"

namespace broadside::bench {

std::span<const core::EngineRow> engines();

// An id of the table, or the path of a plug-in (bench/plugin_engines.hpp). An unknown id is an error that names the
// nearest known one.
core::Result<const core::EngineRow*> find_engine(std::string_view id);

// Why the engine cannot run on this machine, in words for a table cell; empty when it can.
std::string why_absent(const core::EngineRow& row);

}  // namespace broadside::bench

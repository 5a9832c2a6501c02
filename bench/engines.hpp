// The one table of engines.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "core/engine/engine.hpp"
#include "core/result.hpp"

namespace broadside::bench {

std::span<const core::EngineRow> engines();

// An unknown id is an error that names the nearest known one.
core::Result<const core::EngineRow*> find_engine(std::string_view id);

}  // namespace broadside::bench

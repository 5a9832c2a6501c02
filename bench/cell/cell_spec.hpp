// An engine and the settings that the user gave it.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/engine/engine.hpp"
#include "core/result.hpp"

namespace broadside::bench {

using GivenSettings = std::map<std::string, std::string>;

struct CellSpec {
  const core::EngineRow* row = nullptr;
  GivenSettings settings;
};

// "octree-cpu" or, as reports label it, "octree-cpu[levels=A,threads=1]".
core::Result<CellSpec> parse_cell_spec(std::string_view text);

// "octree-cpu" or "octree-cpu[levels=A]", as in the label of its stamp; invalid settings are left out.
std::string label_of(const CellSpec& spec);

bool offers(const core::EngineRow& row, std::string_view capability);

}  // namespace broadside::bench

// An engine as people type it: "octree-cpu[levels=A,threads=1]", taken apart.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace broadside::bench {

struct EngineText {
  std::string id;
  std::map<std::string, std::string> settings;
};

core::Result<EngineText> parse_engine_text(std::string_view text);

}  // namespace broadside::bench

// A scene's name split into its parts: "tower:cube:20[offset=0.2,seed=7]".
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace broadside::datasets {

struct SceneName {
  std::string text;                // as it was given
  std::string plain;               // without the options: "tower:cube:20"
  std::vector<std::string> parts;  // parts of `plain`, between colons
  std::map<std::string, std::string, std::less<>> options;
};

// Error: brackets that do not close, an option without a value, or an option that is given twice.
core::Result<SceneName> parse_scene_name(std::string_view text);

}  // namespace broadside::datasets

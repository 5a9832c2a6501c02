// Refuses settings of octree-cpu and octree-gpu that exist in the published method and not for bodies that turn.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "core/engine/settings.hpp"
#include "core/result.hpp"

namespace broadside::core {

inline Status refuse_method_settings(std::string_view engine, const Settings& settings) {
  for (const auto& [key, sound] :
       {std::pair("variant", "sound"), std::pair("solver", "colored"), std::pair("vertex_stage", "on")})
    if (settings.text(key) != sound)
      return Error{std::string("unsupported: ") + key + " = " + settings.text(key) + " for bodies that turn",
                   std::string(engine), "leave it out, or take a scene whose bodies translate", Exit::kMissing};
  return Done{};
}

}  // namespace broadside::core

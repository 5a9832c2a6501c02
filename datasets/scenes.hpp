// Scenes by name: the one table, and the way from a name or a file to a scene.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "datasets/generators/scene_options.hpp"

namespace broadside::datasets {

struct SceneRow {
  std::string_view pattern;  // "freefall:MESH:N", or a whole name: "errata:E2"
  std::string_view example;  // a name of that pattern
  std::string_view what;
};

std::vector<SceneRow> scene_table();

// `spec` is a name of the table ("freefall:bunny:50") or the path of a scene file (it ends in .toml). The scene has
// passed core::check_scene. Errors name the nearest known scene, or the file and line.
core::Result<core::Scene> make_scene(const std::string& spec, const SceneOptions& options = {});

}  // namespace broadside::datasets

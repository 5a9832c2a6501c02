// Scenes by name: the one table, and the functions that turn a name or a file into a scene.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "datasets/generators/scene_family.hpp"
#include "datasets/generators/scene_options.hpp"

namespace broadside::datasets {

struct SceneRow {
  std::string_view pattern;  // "freefall:MESH:N", or a whole name: "errata:E2"
  std::string_view example;  // a name of that pattern
  std::string_view what;
  std::span<const SceneKnob> knobs;  // in addition to seed, frames, longest_side_m and rigid, which every family has
};

std::vector<SceneRow> scene_table();

// `spec` is a name of the table, perhaps with options ("freefall:bunny:50", "tower:cube:20[offset=0.2,seed=7]"), or the
// path of a scene file (it ends in .toml, .gltf or .glb). MESH in a name is a name of the catalogue or the path of a
// mesh file. Frames and seed of `options` override those of the name. The returned scene has passed core::check_scene.
// Errors name the nearest known scene or option, or the file and line.
core::Result<core::Scene> make_scene(const std::string& spec, const SceneOptions& options = {});

}  // namespace broadside::datasets

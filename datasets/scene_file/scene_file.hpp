// Scenes in TOML files: read, and written.
#pragma once

#include <filesystem>

#include "core/result.hpp"
#include "core/scene/scene.hpp"
#include "datasets/generators/scene_options.hpp"

namespace broadside::datasets {

// datasets/README.md lists the keys. Mesh files are relative to the scene file's folder. The returned scene has passed
// core::check_scene. Errors carry file:line.
core::Result<core::Scene> read_scene_file(const std::filesystem::path& path, const SceneOptions& options);

// Writes every field, bodies one by one, and each mesh as a binary PLY beside the file (STEM.mesh0.ply ...), so that
// read_scene_file gives a scene of the same digest. Each file appears complete under its name or not at all.
core::Status write_scene_file(const core::Scene& scene, const std::filesystem::path& path);

}  // namespace broadside::datasets

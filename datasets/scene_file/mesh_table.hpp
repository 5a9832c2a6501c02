// One [[mesh]] of a scene file: from the catalogue, from a file, or made from a formula.
#pragma once

#include <filesystem>
#include <optional>

#include "core/scene/mesh.hpp"
#include "datasets/mesh/acquire_mesh.hpp"
#include "datasets/scene_file/table_reader.hpp"

namespace broadside::datasets {

// Exactly one of catalogue, file (relative to `folder`) and shape; at most one of longest_side_m and scale. Returns
// nothing after an error, which is then in `errors`.
std::optional<core::Mesh> read_mesh_table(const Node& table, const std::filesystem::path& folder,
                                          const MeshOptions& options, FileErrors& errors);

}  // namespace broadside::datasets

// Scenes from files of other programs: glTF.
#pragma once

#include <filesystem>

#include "core/result.hpp"
#include "core/scene/scene.hpp"

namespace broadside::datasets {

// Every node with triangles becomes a body of 1 kg at rest, at the node's place and rotation; scale goes into its mesh,
// and instances share a mesh. A node whose name ends in "static" is static. glTF is in meters with y upward: gravity is
// standard, the floor of the domain lies under the lowest body, and the other faces are as far from the bodies as the
// longest side of their common box. Engines that only translate keep the rotations fixed.
// Errors: those of core::load_nodes.
core::Result<core::Scene> import_scene(const std::filesystem::path& path);

}  // namespace broadside::datasets

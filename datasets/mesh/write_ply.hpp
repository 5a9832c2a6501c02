// Writes a mesh in the catalogue's own format.
#pragma once

#include <filesystem>

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

// Binary little-endian PLY: float32 x y z, triangles as uchar count and int32 indices; the same mesh gives the same
// bytes. The file appears complete under its name or not at all. Error: it cannot be written (folder, permission,
// space).
core::Status write_ply(const core::Mesh& mesh, const std::filesystem::path& path);

}  // namespace broadside::datasets

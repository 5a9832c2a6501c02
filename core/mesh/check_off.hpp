// Is an OFF file complete? Checked before assimp reads it: when assimp's OFF reader leaves faces out, its face count
// underflows and it reads past the end of its list.
#pragma once

#include <filesystem>

#include "core/result.hpp"

namespace broadside::core {

// Requires the keyword OFF, alone or with assimp's prefixes for colors and normals (ST, C, N, 4); the counts of
// vertices and faces; that many lines of vertices with at least three numbers; and that many lines of faces of 1 to 9
// corners, each a vertex that exists. Error: what is wrong, in one line.
Status check_off(const std::filesystem::path& path);

}  // namespace broadside::core

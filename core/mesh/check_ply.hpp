// Is a PLY file whole? Asked before assimp reads it: its PLY reader trusts the header and runs off the end of a damaged
// file.
#pragma once

#include <filesystem>

#include "core/result.hpp"

namespace broadside::core {

// The header is understood to the last word, there are vertices with x y z and faces with a list of vertex indices, and
// the body is as long as the header says (binary: walked list by list; text: one line per item).
// Error: what is wrong, in one line.
Status check_ply(const std::filesystem::path& path);

}  // namespace broadside::core

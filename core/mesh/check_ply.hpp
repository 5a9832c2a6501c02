// Is a PLY file complete? Checked before assimp reads it: its PLY reader trusts the header and reads past the end of a
// damaged file.
#pragma once

#include <filesystem>

#include "core/result.hpp"

namespace broadside::core {

// Requires that every word of the header is understood, that there are vertices with x y z and faces with a list of
// vertex indices, and that the body is as long as the header says (binary: walked list by list; text: one line per
// item). Error: what is wrong, in one line.
Status check_ply(const std::filesystem::path& path);

}  // namespace broadside::core

// Files that are written or read in one piece.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace broadside::core {

// Writes file + ".part", syncs it, renames it to its final name and syncs the folder: after a crash or a full disk the
// final name holds the old content or the new, never half of either. The folder must exist.
Status write_whole_file(const std::filesystem::path& file, std::string_view content);

// The bytes as they are. A missing or unreadable file is an error.
Result<std::string> read_whole_file(const std::filesystem::path& file);

}  // namespace broadside::core

// Files that appear whole under their name or not at all.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.hpp"

namespace broadside::datasets {

// Writes PATH.part, flushes it to the disk and renames it. Errors say why the system refused: no folder, no permission,
// no space; nothing is left behind then.
core::Status write_whole_file(const std::filesystem::path& path, std::string_view content);

}  // namespace broadside::datasets

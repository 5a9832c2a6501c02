// The SHA-256 sum of a file.
#pragma once

#include <filesystem>
#include <string>

#include "core/result.hpp"

namespace broadside::datasets {

// 64 lowercase hexadecimal digits. Error: the file cannot be read.
core::Result<std::string> sha256_of_file(const std::filesystem::path& path);

}  // namespace broadside::datasets

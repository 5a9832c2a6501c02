// What a file contains, as one number: whether a trace, or what stands beside it, is still the same.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/result.hpp"

namespace broadside::core {

// XXH64 over the bytes, read piece by piece, so that a file may be larger than memory. A missing or unreadable file is
// an error.
Result<std::uint64_t> file_digest(const std::filesystem::path& file);

}  // namespace broadside::core

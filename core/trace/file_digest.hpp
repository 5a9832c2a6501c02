// The content of a file as one number, to find out whether a trace, or a file beside it, is unchanged.
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/result.hpp"

namespace broadside::core {

// XXH64 over the bytes, read in pieces, so that a file may be larger than memory. A missing or unreadable file is an
// error.
Result<std::uint64_t> file_digest(const std::filesystem::path& file);

}  // namespace broadside::core

// The raw format in which users provide their own boxes.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/result.hpp"

namespace broadside::datasets {

// Little-endian: uint32 n, then n times min x y z, max x y z as float32; 4 + 24 n bytes in all.
// Errors, each one line: missing, not a file, unreadable; a size that does not fit n; the first box that is NaN,
// infinite, or has min above max, by its number and axis.
core::Result<std::vector<core::Box>> read_raw_boxes(const std::filesystem::path& path);

// The file appears complete under its name or not at all.
core::Status write_raw_boxes(std::span<const core::Box> boxes, const std::filesystem::path& path);

}  // namespace broadside::datasets

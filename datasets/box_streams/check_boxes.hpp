// Which boxes a broad phase may be given.
#pragma once

#include <span>
#include <string>

#include "core/math/box.hpp"
#include "core/result.hpp"

namespace broadside::datasets {

// Finite, and min <= max on every axis. The error names `where`, the first bad box by its number, and the axis.
core::Status check_boxes(std::span<const core::Box> boxes, const std::string& where);

}  // namespace broadside::datasets

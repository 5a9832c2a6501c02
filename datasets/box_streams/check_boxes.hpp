// Which boxes may be given to a broad phase.
#pragma once

#include <span>
#include <string>

#include "core/math/box.hpp"
#include "core/result.hpp"

namespace broadside::datasets {

// Requires finite boxes with min <= max on every axis. The error has `where`, the number of the first bad box, and the
// axis.
core::Status check_boxes(std::span<const core::Box> boxes, const std::string& where);

}  // namespace broadside::datasets

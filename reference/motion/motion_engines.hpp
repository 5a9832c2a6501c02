// The row of every engine of continuous collision queries; motion_engines.inc is the list.
#pragma once

#include <span>

#include "core/engine/motion_query.hpp"

namespace broadside::reference {

#define MOTION_ENGINE_ROW(function) core::MotionEngineRow function();
#include "reference/motion/motion_engines.inc"
#undef MOTION_ENGINE_ROW

// In the order of the list.
std::span<const core::MotionEngineRow> motion_engine_rows();

}  // namespace broadside::reference

// The row of every engine of this folder. Each function is defined in its engine's file; settings and "what" texts have
// static storage. engines.inc is the list: macros make both the declarations and the table from it, so that an engine
// is in both.
#pragma once

#include <span>

#include "core/engine/engine.hpp"

namespace broadside::reference {

#define ENGINE_ROW(function) core::EngineRow function();
#include "reference/engines.inc"
#undef ENGINE_ROW

using EngineRowFunction = core::EngineRow (*)();

// All of these functions, in the order of the list.
std::span<const EngineRowFunction> engine_rows();

}  // namespace broadside::reference

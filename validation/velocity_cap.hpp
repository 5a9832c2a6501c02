// velocity-cap: no component of a velocity leaves a step faster than v_max.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, P(23): at the end of every frame |v_k| <= v_max for each component of each dynamic body. Static bodies are never
// touched and keep what the scene gave them. Limit: v_max itself; clipping is a comparison and rounds nothing.
ValidatorRow velocity_cap_row();

}  // namespace broadside::validation

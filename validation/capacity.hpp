// capacity: no buffer overflowed in silence.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law: in every frame the pairs stored are as many as the engine demanded room for. An engine that ran out must have
// said so in `demanded`, and then pairs are missing here; one that claims fewer than it stored is broken too. Counts:
// limit 0.
ValidatorRow capacity_row();

}  // namespace broadside::validation

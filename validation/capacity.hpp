// capacity: no buffer overflowed without saying so.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law: in every frame the pairs stored are as many as the engine demanded room for. An engine that ran out of room must
// report the full number in `demanded`; the stored list is then shorter, and fails. An engine that demands fewer than
// it stored is broken too. Counts: limit 0.
ValidatorRow capacity_row();

}  // namespace broadside::validation

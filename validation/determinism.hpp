// determinism: two runs of one stamp are the same run, bit for bit.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, DESIGN 8: a second run of the same scene, engine (or its twin) and settings, on any number of threads, has the
// same frame digests; and where both traces record them, the same bodies, boxes, pairs, contacts and separations. The
// first difference is named by step, body and field.
//
// Limits: 0 differing frames. Bits are compared, so NaN equals itself and +0 differs from -0.
ValidatorRow determinism_row();

}  // namespace broadside::validation

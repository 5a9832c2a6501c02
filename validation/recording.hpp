// recording: what a trace says about its own frames is true.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, core/trace/SCHEMA.md: a trace of level "full" records groups, one of level "digest" none, and "none" leaves no
// trace. With every = k, recorded steps are multiples of k, and inside the windows of steps where the trace names some;
// only the last step, which is always recorded, may be neither. No step that should be recorded is left out, from the
// first step on. Rows of the penetration statistics are those of the recorded contacts, window by window of 100 steps;
// only a file that was cut off may lack the last rows.
//
// Limits: 0 for counts, steps and the largest depth, which are copies. The mean and the share are sums and quotients of
// doubles: n 2^-53 of the sum of n depths, and 2 roundings.
ValidatorRow recording_row();

}  // namespace broadside::validation

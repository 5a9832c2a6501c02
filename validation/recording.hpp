// recording: what a trace says about its own frames is what its frames are.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, core/trace/SCHEMA.md: a trace of level "full" records groups, one of level "digest" none, and "none" leaves no
// trace. Of every = k, steps are multiples of k, inside the windows of steps where the trace names some; only the last
// step, which is always recorded, may be none. From the first step on, none of these is left out. Rows of the
// penetration statistics are those of the recorded contacts, window by window of 100 steps; only a file that was cut
// off may lack the last rows.
//
// Limits: 0 for counts, steps and the largest depth, which are copies. The mean and the share are sums and quotients of
// doubles: n 2^-53 of the sum of n depths, and 2 roundings.
ValidatorRow recording_row();

}  // namespace broadside::validation

// Runs one cell in a child process: a library that aborts or hangs must not take the harness down.
#pragma once

#include "bench/cell_request.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"

namespace broadside::bench {

// This program again, as `broadside run ... --in-process`, with a time limit. Signal, time-out and an unexplained exit
// become cells that say so; bad input of the child comes back as its error. Ctrl-C is passed on.
core::Result<core::Cell> record_cell_in_child(const CellRequest& request, double time_limit_s);

}  // namespace broadside::bench

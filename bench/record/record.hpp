// Records one cell: runs the engine over the scene and writes its trace.
#pragma once

#include <string_view>

#include "bench/cell/cell_request.hpp"
#include "core/result.hpp"
#include "core/rows.hpp"

namespace broadside::bench {

// Records in this process. An error is bad input or a trace that could not be written; an engine that fails by itself
// gives a cell that says so. On Ctrl-C the trace stays as NAME.h5.part, readable up to its last frame, and the cell is
// interrupted. capability: "dynamics", "broad" or "narrow"; empty = the first of these that the engine offers.
core::Result<core::Cell> record_cell(const CellRequest& request, std::string_view capability = {});

}  // namespace broadside::bench

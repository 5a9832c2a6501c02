// Verdicts and cells as plain text for a terminal of 100 columns: words, no color, no control characters.
#pragma once

#include <string>
#include <vector>

#include "core/rows.hpp"

namespace broadside::reports {

constexpr std::size_t kTerminalColumns = 100;

// For one trace: a line per validator with outcome, measured value, limit and place. For several: a line per validator
// and a column per trace, under numbers that a list explains. Below that, how many laws applied. Ends with a newline;
// "no verdicts" when there are none.
std::string verdict_table(const std::vector<core::CellVerdicts>& verdicts);

// One line per cell: engine, state, frames, wall time, and why it is absent or where its trace is.
std::string cell_table(const std::vector<core::Cell>& cells);

// For each failed or inconclusive verdict: label, validator, measured value, limit, step, bodies, origin, in one line
// each (as long as it needs to be: people search these lines). A verdict that sums up several laws is followed by a
// line for each of them that was broken. Empty when there is none.
std::string failure_lines(const std::vector<core::CellVerdicts>& verdicts);

// For each verdict that passes with a warning, the warning, in one line each. Empty when there is none.
std::string warning_lines(const std::vector<core::CellVerdicts>& verdicts);

}  // namespace broadside::reports

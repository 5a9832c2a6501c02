// From many verdicts to one outcome and one exit code.
#pragma once

#include <span>

#include "core/result.hpp"
#include "core/verdict.hpp"

namespace broadside::validation {

// Fail before inconclusive before pass before not applicable; no verdicts at all are not applicable.
core::Outcome worst_outcome(std::span<const core::Verdict> verdicts);

// fail -> 1, inconclusive -> 3, pass and not applicable -> 0: a cell of a run may have no law that applies. `check`,
// which was asked to judge, exits with 3 when nothing was judged.
core::Exit exit_of(core::Outcome outcome);

}  // namespace broadside::validation

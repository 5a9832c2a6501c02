// Runs every validator that applies over one trace in one streamed pass.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/trace/trace_reader.hpp"
#include "core/verdict.hpp"
#include "validation/validator.hpp"

namespace broadside::validation {

// The one table of validators.
std::span<const ValidatorRow> validators();

struct JudgeOptions {
  // Names to run; empty = all. Unknown names are an error with the nearest known one.
  std::vector<std::string> only;
  // Called now and then with frames done and in all.
  std::function<void(std::uint64_t, std::uint64_t)> progress;
};

// One verdict per validator, in the table's order; those that do not apply say why. With a baseline, validators that
// need one compare; the others judge the subject alone. The two scenes must have one digest.
core::Result<std::vector<core::Verdict>> judge(const core::TraceReader& trace, const core::TraceReader* baseline,
                                               const JudgeOptions& options);

}  // namespace broadside::validation

#include "validation/outcome.hpp"

namespace broadside::validation {
core::Outcome worst_outcome(std::span<const core::Verdict> verdicts) {
  core::Outcome worst = core::Outcome::kNotApplicable;
  for (const core::Verdict& verdict : verdicts)
    if (core::severity(verdict.outcome) > core::severity(worst)) worst = verdict.outcome;
  return worst;
}

core::Exit exit_of(core::Outcome outcome) {
  switch (outcome) {
    case core::Outcome::kFail:
      return core::Exit::kFailed;
    case core::Outcome::kInconclusive:
      return core::Exit::kMissing;
    case core::Outcome::kPass:
    case core::Outcome::kNotApplicable:
      return core::Exit::kGood;
  }
  return core::Exit::kInternal;
}

}  // namespace broadside::validation

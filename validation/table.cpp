#include "validation/judge.hpp"

namespace broadside::validation {

// Macros make declarations and table of one list, so that neither can lack a validator.
#define VALIDATOR_ROW(function) ValidatorRow function();
#include "validation/validators.inc"
#undef VALIDATOR_ROW

std::span<const ValidatorRow> validators() {
  static const ValidatorRow kRows[] = {
#define VALIDATOR_ROW(function) function(),
#include "validation/validators.inc"
#undef VALIDATOR_ROW
  };
  return kRows;
}

}  // namespace broadside::validation

#include "validation/judge.hpp"

namespace broadside::validation {

// Macros make declarations and table of one list, so that neither can lack a validator.
#define VALIDATOR_ROW(function) ValidatorRow function();
#define METHOD_ROW(function) ValidatorRow function();
#define MECHANICS_ROW(function) ValidatorRow function();
#include "validation/validators.inc"
#undef VALIDATOR_ROW
#undef METHOD_ROW
#undef MECHANICS_ROW

namespace {

ValidatorRow of_kind(core::LawKind kind, ValidatorRow row) {
  row.kind = kind;
  return row;
}

}  // namespace

std::span<const ValidatorRow> validators() {
  static const ValidatorRow kRows[] = {
#define VALIDATOR_ROW(function) of_kind(core::LawKind::kTrace, function()),
#define METHOD_ROW(function) of_kind(core::LawKind::kMethod, function()),
#define MECHANICS_ROW(function) of_kind(core::LawKind::kMechanics, function()),
#include "validation/validators.inc"
#undef VALIDATOR_ROW
#undef METHOD_ROW
#undef MECHANICS_ROW
  };
  return kRows;
}

}  // namespace broadside::validation

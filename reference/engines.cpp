#include "reference/engines.hpp"

namespace broadside::reference {

std::span<const EngineRowFunction> engine_rows() {
  static constexpr EngineRowFunction kRows[] = {
#define ENGINE_ROW(function) function,
#include "reference/engines.inc"
#undef ENGINE_ROW
  };
  return kRows;
}

}  // namespace broadside::reference

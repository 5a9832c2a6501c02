// What a trace of format 1 implies about its engine. That format has no declaration: the engine's name implied what
// engines now declare. The table is final, so that old traces keep their verdicts.
#pragma once

#include <string_view>

#include "core/engine/declaration.hpp"

namespace broadside::core {

Declaration declaration_of_format1(std::string_view engine);

}  // namespace broadside::core

// What a trace of format 1 says of its engine. That format has no declaration: there, names stood for what engines now
// declare. The table is closed, so that old traces keep their verdicts.
#pragma once

#include <string_view>

#include "core/engine/declaration.hpp"

namespace broadside::core {

Declaration declaration_of_format1(std::string_view engine);

}  // namespace broadside::core

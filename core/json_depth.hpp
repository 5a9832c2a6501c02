// How deep does a JSON text nest? Asked before parsers and writers that use stack for each level see it.
#pragma once

#include <cstddef>
#include <string_view>

namespace broadside::core {

// The most brackets that are open at one place, outside of strings. What is no JSON is for the parser to refuse.
std::size_t json_depth(std::string_view text);

}  // namespace broadside::core

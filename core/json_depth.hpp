// How deeply does a JSON text nest? Checked before it reaches parsers and writers that use stack for each level.
#pragma once

#include <cstddef>
#include <string_view>

namespace broadside::core {

// The largest number of brackets that are open at one place, outside of strings. Rejecting text that is not JSON is
// left to the parser.
std::size_t json_depth(std::string_view text);

}  // namespace broadside::core

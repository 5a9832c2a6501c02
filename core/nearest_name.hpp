// The known name nearest to what somebody typed, for "did you mean".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace broadside::core {

// By edit distance; the first of equals. Empty when there is no known name.
std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> known);

// "did you mean 'x'?" for near misses, otherwise "one of: a, b, c", or of more names than a line holds "the nearest is
// 'x'".
std::string advise_name(std::string_view typed, std::span<const std::string_view> known);

}  // namespace broadside::core

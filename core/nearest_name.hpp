// The known name nearest to what somebody typed, for "did you mean".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace broadside::core {

// By edit distance; the first of equals. Empty when there is no known name.
std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> known);

// "did you mean 'x'?" for near misses. Otherwise "one of: a b c"; of more names than a line holds, the command that
// lists them, where there is one: "'broadside list engines' shows them". Before it stands the nearest name that begins
// with the same part before a colon, if there is such a name.
std::string advise_name(std::string_view typed, std::span<const std::string_view> known,
                        std::string_view listed_by = {});

}  // namespace broadside::core

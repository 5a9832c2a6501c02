// The known name nearest to the typed one, for "did you mean".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace broadside::core {

// By edit distance; the first among equals. Empty when there is no known name.
std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> known);

// "did you mean 'x'?" for near misses. Otherwise "one of: a b c"; when a line cannot hold all names, the command that
// lists them, where there is one: "'broadside list engines' shows them". If a name has the same part before a colon,
// the nearest such name comes first.
std::string advise_name(std::string_view typed, std::span<const std::string_view> known,
                        std::string_view listed_by = {});

}  // namespace broadside::core

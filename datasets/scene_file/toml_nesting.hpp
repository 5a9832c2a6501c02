// How deeply does a TOML text nest? Checked before the parser, which makes a table within a table for each part of a
// dotted name and frees them by recursion, so that a single long name exhausts the stack.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace broadside::datasets {

// Scene and campaign files use three levels of brackets and names of two parts.
inline constexpr std::size_t kDeepestToml = 32;    // brackets that are open at one place
inline constexpr std::size_t kMostNameParts = 32;  // parts of one dotted name

struct TomlNesting {
  std::size_t brackets = 0;
  std::size_t name_parts = 0;
  std::uint32_t line = 0;  // 1-based line of the first place beyond a limit; 0 where there is none
};

// Reads up to the first place beyond a limit. Text within strings and comments does not count. Rejecting text that is
// not TOML is left to the parser.
TomlNesting toml_nesting(std::string_view text);

}  // namespace broadside::datasets

// How deep does a TOML text nest? Asked before the parser, which makes a table within a table for each part of a dotted
// name and frees them by recursion, so that a long name alone runs out of stack.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace broadside::datasets {

// Scene and campaign files use three levels of brackets and names of two parts.
inline constexpr std::size_t kDeepestToml = 32;    // brackets open at one place
inline constexpr std::size_t kMostNameParts = 32;  // of one dotted name

struct TomlNesting {
  std::size_t brackets = 0;
  std::size_t name_parts = 0;
  std::uint32_t line = 0;  // 1-based, of the first place that is past a limit; 0 where none is
};

// Reads to the first place past a limit. Text within strings and comments does not count. What is no TOML is for the
// parser to refuse.
TomlNesting toml_nesting(std::string_view text);

}  // namespace broadside::datasets

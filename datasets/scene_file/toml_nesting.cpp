#include "datasets/scene_file/toml_nesting.hpp"

#include <algorithm>

namespace broadside::datasets {
namespace {

// The offset after the string that begins at `at`: "..." or '...', or either with three quotes over several lines.
std::size_t behind_string(std::string_view text, std::size_t at, std::uint32_t& line) {
  const char quote = text[at];
  const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
  const bool has_lines = text.substr(at).starts_with(three);
  at += has_lines ? 3 : 1;
  for (; at < text.size(); ++at) {
    if (text[at] == '\n') {
      if (!has_lines) return at;
      ++line;
    }
    if (text[at] == '\\' && quote == '"') {
      ++at;
      if (at < text.size() && text[at] == '\n') ++line;
      continue;
    }
    if (text[at] != quote) continue;
    if (!has_lines) return at + 1;
    if (!text.substr(at).starts_with(three)) continue;
    // Up to two more quotes belong to the text.
    at += 3;
    for (int more = 0; more < 2 && at < text.size() && text[at] == quote; ++more) ++at;
    return at;
  }
  return text.size();
}

}  // namespace

TomlNesting toml_nesting(std::string_view text) {
  TomlNesting nesting;
  std::uint32_t line = 1;
  std::size_t depth = 0;
  std::size_t parts = 1;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      at = behind_string(text, at, line);
      continue;
    }
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
      continue;
    }
    if (c == '[' || c == '{') nesting.brackets = std::max(nesting.brackets, ++depth);
    if ((c == ']' || c == '}') && depth > 0) --depth;
    // A name ends at any character that it cannot contain.
    if (c == '.') nesting.name_parts = std::max(nesting.name_parts, ++parts);
    if (c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}' || c == '\n') parts = 1;
    if (nesting.brackets > kDeepestToml || nesting.name_parts > kMostNameParts) {
      nesting.line = line;
      return nesting;
    }
    if (c == '\n') ++line;
    ++at;
  }
  return nesting;
}

}  // namespace broadside::datasets

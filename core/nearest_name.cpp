#include "core/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace broadside::core {
namespace {

// Levenshtein distance, one row at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

constexpr std::size_t kMostInALine = 16;

}  // namespace

std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> known) {
  std::string_view best;
  std::size_t best_distance = static_cast<std::size_t>(-1);
  for (const std::string_view name : known) {
    const std::size_t d = edit_distance(typed, name);
    if (d < best_distance) best = name, best_distance = d;
  }
  return best;
}

std::string advise_name(std::string_view typed, std::span<const std::string_view> known) {
  const std::string_view best = nearest_name(typed, known);
  // Up to a third of the longer word may be wrong for it to be taken as a typing error.
  if (!best.empty() && edit_distance(typed, best) * 3 <= std::max(typed.size(), best.size()))
    return "did you mean '" + std::string(best) + "'?";
  if (known.size() > kMostInALine) return "the nearest is '" + std::string(best) + "'";
  std::string text = "one of:";
  for (const std::string_view name : known) text += " " + std::string(name);
  return text;
}

}  // namespace broadside::core

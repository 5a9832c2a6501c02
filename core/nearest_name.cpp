#include "core/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace broadside::core {
namespace {

// Counts letters that are missing, extra or wrong, and swapped neighbors, each once.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  std::vector<std::size_t> above = row;
  std::vector<std::size_t> above_that = row;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(above_that, above);
    std::swap(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], above_that[j - 2] + 1);
    }
  }
  return row[b.size()];
}

// A word counts as a typing error when at most a third of the longer word is wrong.
bool is_near(std::string_view typed, std::string_view name) {
  return edit_distance(typed, name) * 3 <= std::max(typed.size(), name.size());
}

// "freefall" of "freefall:bunny:50".
std::string_view head_of(std::string_view name) {
  return name.substr(0, name.find(':'));
}

// The nearest among the names whose first part matches; empty where there is none.
std::string_view nearest_of_kind(std::string_view typed, std::span<const std::string_view> known) {
  if (typed.find(':') == std::string_view::npos) return {};
  std::vector<std::string_view> heads;
  for (const std::string_view name : known) heads.push_back(head_of(name));
  const std::string_view head = nearest_name(head_of(typed), heads);
  if (!is_near(head_of(typed), head)) return {};
  // Among those, keeps the names that share the longest beginning with it.
  std::vector<std::string_view> of_kind;
  std::ptrdiff_t longest = -1;
  for (const std::string_view name : known) {
    if (head_of(name) != head) continue;
    const std::ptrdiff_t shared =
        std::mismatch(typed.begin(), typed.end(), name.begin(), name.end()).first - typed.begin();
    if (shared > longest) of_kind.clear(), longest = shared;
    if (shared == longest) of_kind.push_back(name);
  }
  return nearest_name(typed, of_kind);
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

std::string advise_name(std::string_view typed, std::span<const std::string_view> known, std::string_view listed_by) {
  const std::string_view best = nearest_name(typed, known);
  if (!best.empty() && is_near(typed, best)) return "did you mean '" + std::string(best) + "'?";
  if (known.size() > kMostInALine && !listed_by.empty()) {
    const std::string_view like = nearest_of_kind(typed, known);
    const std::string proposal = like.empty() ? "" : "did you mean one like '" + std::string(like) + "'? ";
    return proposal + "'" + std::string(listed_by) + "' shows them";
  }
  std::string text = "one of:";
  for (const std::string_view name : known) text += " " + std::string(name);
  return text;
}

}  // namespace broadside::core

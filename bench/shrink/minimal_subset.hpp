// Delta debugging: a smallest part of a list that still shows a fault.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace broadside::bench {

// fails(part): whether this part, in the list's order, still shows the fault, as the whole list does. is_spent():
// whether to stop with the best part so far. The result fails, and no single item can be left out of it unless time ran
// out (Zeller and Hildebrandt, "Simplifying and isolating failure-inducing input", 2002: their ddmin). Deterministic.
template <typename T, typename Fails, typename IsSpent>
std::vector<T> minimal_subset(std::vector<T> items, Fails fails, IsSpent is_spent) {
  std::size_t parts = 2;
  while (items.size() >= 2 && !is_spent()) {
    const std::size_t size = (items.size() + parts - 1) / parts;
    bool is_smaller = false;
    // First tries each half alone, then the list without each of its ever smaller parts.
    for (std::size_t begin = 0; begin < items.size() && !is_smaller && !is_spent(); begin += size) {
      const auto first = items.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto last = items.begin() + static_cast<std::ptrdiff_t>(std::min(begin + size, items.size()));
      std::vector<T> part;
      if (parts == 2) {
        part.assign(first, last);
      } else {
        part.assign(items.begin(), first);
        part.insert(part.end(), last, items.end());
      }
      if (!fails(part)) continue;
      items = std::move(part);
      parts = parts == 2 ? 2 : std::max<std::size_t>(parts - 1, 2);
      is_smaller = true;
    }
    if (is_smaller) continue;
    if (size == 1) break;
    parts = std::min(parts == 2 ? 4 : parts * 2, items.size());
  }
  return items;
}

}  // namespace broadside::bench

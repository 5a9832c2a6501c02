// The order in which contacts are resolved: METHOD leaves it open and the paper races (E8); this is ours.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/pair.hpp"

namespace broadside::core {

// Contacts are colored greedily in the order of this priority (smaller first): each takes the smallest color that no
// earlier contact of its dynamic bodies took. Static bodies are never written, so they never conflict. splitmix64 is a
// bijection, so priorities of different pairs differ and the coloring is one fixed function of the set of contacts;
// being pseudo-random, the greedy order has short dependency chains, so that parallel rounds (Jones and Plassmann,
// 1993) reach the same coloring quickly.
BROADSIDE_HD constexpr std::uint64_t color_priority(Pair p) {
  return splitmix64(pair_key(p));
}

}  // namespace broadside::core

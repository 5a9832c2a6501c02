// The order in which contacts are resolved. METHOD leaves it open, the paper's threads race (E8); this order is ours.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/pair.hpp"

namespace broadside::core {

// Contacts are resolved in the order of this priority (smaller first): an order that is one fixed function of the set
// of contacts, because splitmix64 is a bijection and the priorities of different pairs differ. Two contacts that share
// no written body may change places, so a contact waits only for earlier contacts of its own bodies; its color is the
// length of the longest chain of contacts that wait for each other before it. Contacts of one color share no written
// body, and color by color is the same order. Being pseudo-random, the order has short chains (Jones and Plassmann,
// 1993): some 2.5 times the most contacts of one body, in piles.
BROADSIDE_HD constexpr std::uint64_t color_priority(Pair p) {
  return splitmix64(pair_key(p));
}

}  // namespace broadside::core

// The order in which contacts are resolved. METHOD leaves it open, and the paper's threads race (E8); this order is
// ours.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/pair.hpp"

namespace broadside::core {

// Contacts are resolved in the order of this priority (smaller first). It is a fixed function of the set of contacts,
// because splitmix64 is a bijection and so different pairs have different priorities. Two contacts that share no
// written body may be swapped, so a contact waits only for earlier contacts of its own bodies. Its color is the length
// of the longest chain of such waiting contacts before it. Contacts of one color share no written body, so resolving
// color by color is equivalent. Because the order is pseudo-random, its chains are short (Jones and Plassmann, 1993):
// in piles, some 2.5 times the largest number of contacts of one body.
BROADSIDE_HD constexpr std::uint64_t color_priority(Pair p) {
  return splitmix64(pair_key(p));
}

}  // namespace broadside::core

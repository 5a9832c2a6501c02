// The word of global memory by which the blocks of a grid meet: the shares of all of them together flip the highest bit
// and leave the others as they were, so nobody resets anything.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"

namespace broadside::gpu {

struct GridWord {
  // The lowest bits are for something else that is added up.
  static constexpr unsigned long long kTally = (1ULL << 48) - 1;
  static constexpr unsigned long long kArrival = kTally + 1;
  static constexpr unsigned long long kFlipped = 1ULL << 63;

  BROADSIDE_HD static unsigned long long share(std::uint32_t block, std::uint32_t blocks) {
    return block == 0 ? kFlipped - (blocks - 1) * kArrival : kArrival;
  }
};

// What whoever has met knows, of one moment: the lowest bits of the word, and the word behind it.
struct GridTally {
  unsigned long long tally = 0;
  unsigned long long behind = 0;
};

}  // namespace broadside::gpu

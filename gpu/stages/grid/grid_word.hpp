// The word of global memory on which a grid's barrier counts. Every block adds its share. All shares together flip the
// highest bit and leave the other bits as they were, so the word needs no reset.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"

namespace broadside::gpu {

struct GridWord {
  // The lowest bits hold the tally: counts that blocks add before they arrive.
  static constexpr unsigned long long kTally = (1ULL << 48) - 1;
  static constexpr unsigned long long kArrival = kTally + 1;
  static constexpr unsigned long long kFlipped = 1ULL << 63;

  BROADSIDE_HD static unsigned long long share(std::uint32_t block, std::uint32_t blocks) {
    return block == 0 ? kFlipped - (blocks - 1) * kArrival : kArrival;
  }
};

}  // namespace broadside::gpu

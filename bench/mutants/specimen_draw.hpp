// Numbers from a seed, the same on every machine.
#pragma once

#include <cstdint>

#include "core/pair.hpp"

namespace broadside::bench {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(core::splitmix64(seed)) {}
  float uniform(float low, float high) {
    state_ = core::splitmix64(state_);
    return low + (high - low) * (static_cast<float>(state_ >> 40U) * 0x1p-24F);
  }

 private:
  std::uint64_t state_;
};

}  // namespace broadside::bench

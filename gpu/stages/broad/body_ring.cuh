// All pairs of bodies, dealt out evenly.
#pragma once

#include <cstdint>

#include "gpu/frame/divisor.hpp"
#include "gpu/frame/ring_shares.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// Bodies lie on a ring, and body i is paired with those 1 to n / 2 places after it. So every pair comes once, without a
// square root as pairs in a triangle would need, and every body has as many pairs as the next. An item is one body with
// `share` of the places after it, a lane each. Divisor: FloatDivisor if items are few enough for it, else
// IntegerDivisor.
template <typename Divisor>
class BodyRing {
 public:
  using Item = typename Divisor::Number;

  struct RingPair {
    std::uint32_t i = 0;
    std::uint32_t j = 0;  // i if there is no pair
    bool exists = false;
  };

  // `shares` divides by ring_shares(bodies, share).
  __device__ BodyRing(std::uint32_t bodies, std::uint32_t share, const Divisor& shares)
      : bodies_(bodies), half_(bodies / 2), share_(share), shares_(shares) {}

  __device__ Item items() const { return Item{bodies_} * shares_.by(); }

  // This lane's pair in an item, which must exist.
  __device__ RingPair pair_of(Item item) const {
    const std::uint32_t i = shares_.quotient(item);
    return pair_of(i, static_cast<std::uint32_t>(item - Item{i} * shares_.by()));
  }

 private:
  __device__ RingPair pair_of(std::uint32_t i, std::uint32_t part) const {
    const std::uint32_t on = part * share_ + lane() + 1;
    // If the number of bodies is even, two that are opposite on the ring would meet twice: the lower one takes the
    // pair.
    const bool exists = lane() < share_ && on <= half_ && (on * 2 != bodies_ || i < half_);
    if (!exists) return {i, i, false};
    return {i, i < bodies_ - on ? i + on : i - (bodies_ - on), true};
  }

  std::uint32_t bodies_;
  std::uint32_t half_;
  std::uint32_t share_;
  Divisor shares_;
};

}  // namespace broadside::gpu

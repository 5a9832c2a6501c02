// All pairs of bodies, dealt out evenly.
#pragma once

#include <cstdint>

#include "gpu/frame/divisor.hpp"
#include "gpu/frame/ring_shares.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// Bodies on a ring: body i is paired with those 1 to n / 2 places on, so that every pair comes once without a root or a
// triangle, and every body has as much to do as the next. An item is one body and `share` places on from it, a lane
// each. Divisor: FloatDivisor where there are fewer items than it can divide, or IntegerDivisor.
template <typename Divisor>
class BodyRing {
 public:
  using Item = typename Divisor::Number;

  struct RingPair {
    std::uint32_t i = 0;
    std::uint32_t j = 0;  // i where there is none
    bool exists = false;
  };

  // `shares` divides by ring_shares(bodies).
  __device__ BodyRing(std::uint32_t bodies, std::uint32_t share, const Divisor& shares)
      : bodies_(bodies), half_(bodies / 2), share_(share), shares_(shares) {}

  __device__ Item items() const { return Item{bodies_} * shares_.by(); }

  // Of this lane, in an item that exists.
  __device__ RingPair pair_of(Item item) const {
    const std::uint32_t i = shares_.quotient(item);
    return pair_of(i, static_cast<std::uint32_t>(item - Item{i} * shares_.by()));
  }

 private:
  __device__ RingPair pair_of(std::uint32_t i, std::uint32_t part) const {
    const std::uint32_t on = part * share_ + lane() + 1;
    // Two bodies that face each other on an even ring are one pair.
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

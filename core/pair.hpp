// An unordered pair of bodies, stored with i < j, and the order-free digest of a set of them.
#pragma once

#include <compare>
#include <cstdint>
#include <span>

#include "core/attributes.hpp"

namespace broadside::core {

struct Pair {
  std::uint32_t i = 0;
  std::uint32_t j = 0;

  friend constexpr auto operator<=>(const Pair&, const Pair&) = default;
};

BROADSIDE_HD constexpr Pair make_pair_of(std::uint32_t p, std::uint32_t q) {
  return p < q ? Pair{p, q} : Pair{q, p};
}

BROADSIDE_HD constexpr std::uint64_t splitmix64(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

BROADSIDE_HD constexpr std::uint64_t pair_key(Pair p) {
  return (static_cast<std::uint64_t>(p.i) << 32) | p.j;
}

// Sum modulo 2^64 over the pairs, so any order gives the same digest and threads may add in any order.
inline std::uint64_t pair_digest(std::span<const Pair> pairs) {
  std::uint64_t sum = 0;
  for (const Pair p : pairs) sum += splitmix64(pair_key(p));
  return sum;
}

}  // namespace broadside::core

// How far apart two numbers are, counted in representable numbers.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace broadside::core {

// Returned in place of a count when one of the two numbers is a NaN.
inline constexpr std::uint64_t kNoUlps = std::numeric_limits<std::uint64_t>::max();

// The number of steps from one representable number to the next that lead from a to b: 0 for equal bits and for +0 and
// -0, 1 for neighbors; infinity is the neighbor of the largest finite number. kNoUlps when one is a NaN and the bits
// differ.
template <typename Real>
std::uint64_t ulps_between(Real a, Real b) {
  static_assert(std::is_same_v<Real, float> || std::is_same_v<Real, double>);
  using Word = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  constexpr Word kSign = Word{1} << (8U * sizeof(Word) - 1U);
  const auto u = std::bit_cast<Word>(a);
  const auto v = std::bit_cast<Word>(b);
  if (u == v) return 0;
  if (std::isnan(a) || std::isnan(b)) return kNoUlps;
  // Without the sign, the bits count upwards from 0. So numbers of opposite signs are apart by the sum of both counts.
  const std::uint64_t p = u & ~kSign;
  const std::uint64_t q = v & ~kSign;
  if ((u & kSign) != (v & kSign)) return p + q;
  return p > q ? p - q : q - p;
}

}  // namespace broadside::core

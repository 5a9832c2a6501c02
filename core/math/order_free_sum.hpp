// A sum of nonnegative floats that is the same for every order of its terms: for threads that add up in parallel.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "core/attributes.hpp"

namespace broadside::core {

// Terms are counted in whole units, a power of two of which the largest term has 2^40 to 2^41. Each term thus loses
// less than a 2^40th of the largest one. Sums of integers do not depend on the order. Up to 2^22 terms.
class OrderFreeSum {
 public:
  // largest: the largest of all terms; finite.
  BROADSIDE_HD explicit constexpr OrderFreeSum(float largest) {
    const auto exponent = static_cast<int>(std::bit_cast<std::uint32_t>(largest) >> 23) - 127;
    // A subnormal or zero counts as the least normal number here.
    shift_ = 40 - (exponent < -126 ? -126 : exponent);
  }

  // The units of one term.
  BROADSIDE_HD constexpr std::uint64_t units(float term) const {
    return static_cast<std::uint64_t>(static_cast<double>(term) * power_of_two(shift_));
  }
  BROADSIDE_HD constexpr float value(std::uint64_t sum_of_units) const {
    return static_cast<float>(static_cast<double>(sum_of_units) * power_of_two(-shift_));
  }

 private:
  BROADSIDE_HD static constexpr double power_of_two(int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
  }

  int shift_ = 0;
};

// Precondition: the terms are finite and not negative.
inline float order_free_sum(std::span<const float> terms) {
  const OrderFreeSum sum(terms.empty() ? 0.0F : *std::max_element(terms.begin(), terms.end()));
  std::uint64_t units = 0;
  for (const float term : terms) units += sum.units(term);
  return sum.value(units);
}

}  // namespace broadside::core

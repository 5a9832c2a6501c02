// Divisions by a number that is known beforehand.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"

namespace broadside::gpu {

// Divides numbers below 2^20 by the same divisor again and again, in a few steps instead of some thirty. It is exact,
// because half a unit is added to the dividend: that keeps the quotient farther from the next whole number than
// rounding can move it.
class FloatDivisor {
 public:
  using Number = std::uint32_t;

  FloatDivisor() = default;
  BROADSIDE_HD explicit FloatDivisor(std::uint32_t by) : by_(by), inverse_(1.0F / static_cast<float>(by)) {}

  BROADSIDE_HD std::uint32_t by() const { return by_; }
  BROADSIDE_HD std::uint32_t quotient(std::uint32_t of) const {
    return static_cast<std::uint32_t>((static_cast<float>(of) + 0.5F) * inverse_);
  }
  BROADSIDE_HD std::uint32_t rounded_up(std::uint32_t of) const { return quotient(of + by_ - 1); }

 private:
  std::uint32_t by_ = 1;
  float inverse_ = 1.0F;
};

// The same for dividends of any size.
class IntegerDivisor {
 public:
  using Number = std::uint64_t;

  BROADSIDE_HD explicit IntegerDivisor(std::uint32_t by) : by_(by) {}

  BROADSIDE_HD std::uint32_t by() const { return by_; }
  BROADSIDE_HD std::uint32_t quotient(std::uint64_t of) const { return static_cast<std::uint32_t>(of / by_); }

 private:
  std::uint32_t by_;
};

}  // namespace broadside::gpu

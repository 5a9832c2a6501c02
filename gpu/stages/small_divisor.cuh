// Divisions of small numbers.
#pragma once

#include <cstdint>

#include "gpu/stages/device.cuh"

namespace broadside::gpu {

// Divides below 2^20 by the same number again and again, in a few steps instead of some thirty: half a unit above the
// quotient is farther from the next whole number than roundings reach.
class SmallDivisor {
 public:
  __device__ explicit SmallDivisor(std::uint32_t by) : by_(by), inverse_(1.0F / static_cast<float>(by)) {}

  __device__ std::uint32_t quotient(std::uint32_t of) const {
    return static_cast<std::uint32_t>((static_cast<float>(of) + 0.5F) * inverse_);
  }
  __device__ std::uint32_t rounded_up(std::uint32_t of) const { return quotient(of + by_ - 1); }

 private:
  std::uint32_t by_;
  float inverse_;
};

}  // namespace broadside::gpu

// Random draws that give the same bits on every platform: integers from splitmix64, and arithmetic that IEEE 754 fixes.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/math/vec3.hpp"
#include "core/pair.hpp"

namespace broadside::datasets {

// Uses no function of libm except sqrt, which IEEE 754 rounds correctly: sin, cos, log and pow differ between libraries
// in the last bit, and a scene must be the same everywhere.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    const std::uint64_t drawn = core::splitmix64(state_);
    state_ += 0x9e3779b97f4a7c15ULL;
    return drawn;
  }

  // Uniform in [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  // Uniform in [low, high).
  double between(double low, double high) { return low + (high - low) * unit(); }

  // Uniform in 0 ... count - 1; count > 0. Multiply-shift: the bias is below count / 2^32, negligible for the counts
  // used here.
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(((bits() >> 32) * count) >> 32); }

  struct Direction {
    double x, y, z;
  };

  // Uniform on the unit sphere, by rejection from the cube.
  Direction direction() {
    for (;;) {
      const double x = between(-1.0, 1.0);
      const double y = between(-1.0, 1.0);
      const double z = between(-1.0, 1.0);
      const double squared = (x * x + y * y) + z * z;
      // Points too near the center would lose digits; points outside the ball would crowd directions at the cube's
      // corners.
      if (squared > 1.0 || squared < 1e-4) continue;
      const double r = std::sqrt(squared);
      return {x / r, y / r, z / r};
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace broadside::datasets

// Orders of the cells of a cubic grid: Morton's, which an octree's nodes follow, and Hilbert's, in which neighbors in
// the order are always neighbors in space.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"

namespace broadside::core {

// Cell coordinates have at most this many bits, so that a code fits in 32.
inline constexpr int kCurveBits = 10;

// Spreads the bits of a 10-bit number to every third bit.
BROADSIDE_HD constexpr std::uint32_t spread_by_three(std::uint32_t v) {
  v = (v | (v << 16U)) & 0x030000FFU;
  v = (v | (v << 8U)) & 0x0300F00FU;
  v = (v | (v << 4U)) & 0x030C30C3U;
  return (v | (v << 2U)) & 0x09249249U;
}

// x has the lowest bit of each triple.
BROADSIDE_HD constexpr std::uint32_t morton_code(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return spread_by_three(x) | (spread_by_three(y) << 1U) | (spread_by_three(z) << 2U);
}

// Hilbert's order by Skilling's transposed form ("Programming the Hilbert curve", AIP Conf. Proc. 707, 2004): one step
// for each bit of the coordinates from the highest down to bit 1, then a final step. It has no branches and exposes
// single steps, so that a loop over many cells per step vectorizes and GPU threads do not diverge.
struct CurveCell {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t z = 0;
};

BROADSIDE_HD constexpr void hilbert_step(std::uint32_t& x, std::uint32_t& y, std::uint32_t& z, int bit) {
  const std::uint32_t low = (1U << static_cast<unsigned>(bit)) - 1U;
  // Where the axis has the bit, invert the low bits of x; where it has not, exchange them with those of that axis.
  std::uint32_t has = 0U - ((x >> static_cast<unsigned>(bit)) & 1U);
  x ^= low & has;
  has = 0U - ((y >> static_cast<unsigned>(bit)) & 1U);
  std::uint32_t swap = (x ^ y) & low & ~has;
  x ^= swap ^ (low & has);
  y ^= swap;
  has = 0U - ((z >> static_cast<unsigned>(bit)) & 1U);
  swap = (x ^ z) & low & ~has;
  x ^= swap ^ (low & has);
  z ^= swap;
}

BROADSIDE_HD constexpr std::uint32_t hilbert_finish(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  y ^= x;
  z ^= y;
  // Bit k of t: parity of the bits of z above k.
  std::uint32_t t = z >> 1U;
  t ^= t >> 1U;
  t ^= t >> 2U;
  t ^= t >> 4U;
  t ^= t >> 8U;
  return morton_code(z ^ t, y ^ t, x ^ t);
}

// Coordinates below 2^bits; the code is below 2^(3 bits).
BROADSIDE_HD constexpr std::uint32_t hilbert_code(CurveCell cell, int bits) {
  for (int bit = bits - 1; bit > 0; --bit) hilbert_step(cell.x, cell.y, cell.z, bit);
  return hilbert_finish(cell.x, cell.y, cell.z);
}

}  // namespace broadside::core

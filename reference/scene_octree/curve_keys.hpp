// Hilbert codes for many boxes at a time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/math/box.hpp"
#include "core/method/size_tree.hpp"

namespace broadside::reference {

// One step of the curve is taken for this many cells at a time, so that the loop vectorizes.
inline constexpr std::size_t kCurveTile = 64;

// Cells in, codes out in x. All three hold kCurveTile numbers below 2^bits.
void hilbert_codes(std::uint32_t* x, std::uint32_t* y, std::uint32_t* z, int bits);

// Calls use(k, code) for k in [begin, end), with the code of the center of box_at(k) in the grid.
template <typename BoxAt, typename Use>
void for_each_code(const core::CurveGrid& grid, std::size_t begin, std::size_t end, const BoxAt& box_at,
                   const Use& use) {
  std::uint32_t x[kCurveTile] = {};
  std::uint32_t y[kCurveTile] = {};
  std::uint32_t z[kCurveTile] = {};
  for (std::size_t first = begin; first < end; first += kCurveTile) {
    const std::size_t count = std::min(kCurveTile, end - first);
    for (std::size_t k = 0; k < count; ++k) {
      const core::CurveCell cell = core::curve_cell(grid, box_at(first + k));
      x[k] = cell.x;
      y[k] = cell.y;
      z[k] = cell.z;
    }
    hilbert_codes(x, y, z, grid.bits);
    for (std::size_t k = 0; k < count; ++k) use(first + k, x[k]);
  }
}

}  // namespace broadside::reference

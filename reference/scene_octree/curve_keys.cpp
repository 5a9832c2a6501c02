#include "reference/scene_octree/curve_keys.hpp"

namespace broadside::reference {

// Integers alone, so every instruction set gives the same bits.
#if defined(BROADSIDE_HAS_AVX2_KERNEL)
__attribute__((target_clones("avx2", "default")))
#endif
void hilbert_codes(std::uint32_t* __restrict x, std::uint32_t* __restrict y, std::uint32_t* __restrict z, int bits) {
  for (int bit = bits - 1; bit > 0; --bit)
    for (std::size_t k = 0; k < kCurveTile; ++k) core::hilbert_step(x[k], y[k], z[k], bit);
  for (std::size_t k = 0; k < kCurveTile; ++k) x[k] = core::hilbert_finish(x[k], y[k], z[k]);
}

}  // namespace broadside::reference

// Four doubles side by side, with the operations of core/continuous/lane_math.hpp: the result in each lane has the same
// bits as with a single double.
#include <immintrin.h>

#include "core/continuous/lane_math.hpp"
#include "reference/continuous/impact_kernel.hpp"

namespace broadside::reference {
namespace avx2 {

struct Mask {
  __m256d bits;

  friend Mask operator&(Mask a, Mask b) { return {_mm256_and_pd(a.bits, b.bits)}; }
  friend Mask operator|(Mask a, Mask b) { return {_mm256_or_pd(a.bits, b.bits)}; }
  friend Mask operator!(Mask a) { return {_mm256_xor_pd(a.bits, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)))}; }
  // Bit k is lane k.
  [[nodiscard]] unsigned lanes() const { return static_cast<unsigned>(_mm256_movemask_pd(bits)); }
};

inline bool any(Mask a) {
  return a.lanes() != 0;
}

struct Lanes {
  static constexpr int kWidth = 4;
  __m256d v;

  Lanes() : v(_mm256_setzero_pd()) {}
  Lanes(__m256d given) : v(given) {}
  Lanes(double x) : v(_mm256_set1_pd(x)) {}

  friend Lanes operator+(Lanes a, Lanes b) { return _mm256_add_pd(a.v, b.v); }
  friend Lanes operator-(Lanes a, Lanes b) { return _mm256_sub_pd(a.v, b.v); }
  friend Lanes operator*(Lanes a, Lanes b) { return _mm256_mul_pd(a.v, b.v); }
  friend Lanes operator/(Lanes a, Lanes b) { return _mm256_div_pd(a.v, b.v); }
  friend Mask operator<(Lanes a, Lanes b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_LT_OQ)}; }
  friend Mask operator<=(Lanes a, Lanes b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_LE_OQ)}; }
  friend Mask operator>(Lanes a, Lanes b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_GT_OQ)}; }
  friend Mask operator>=(Lanes a, Lanes b) { return {_mm256_cmp_pd(a.v, b.v, _CMP_GE_OQ)}; }

  // Loads as many points as there are lanes, each of three doubles, or of four floats of which the last one is ignored.
  static continuous::Triple<Lanes> points(const double* const (&at)[kWidth]);
  static continuous::Triple<Lanes> points(const float* const (&at)[kWidth]);

  static Lanes load(const double* from) { return _mm256_loadu_pd(from); }
  void store(double* to) const { _mm256_storeu_pd(to, v); }
};

inline Lanes pick(Mask is_first, Lanes first, Lanes second) {
  return _mm256_blendv_pd(second.v, first.v, is_first.bits);
}
inline Lanes magnitude(Lanes x) {
  return _mm256_andnot_pd(_mm256_set1_pd(-0.0), x.v);
}
// min and max give the second argument where neither is less: as a < b ? a : b.
inline Lanes lesser(Lanes a, Lanes b) {
  return _mm256_min_pd(a.v, b.v);
}
inline Lanes larger(Lanes a, Lanes b) {
  return _mm256_max_pd(a.v, b.v);
}

// The first three rows of a matrix of four columns.
inline continuous::Triple<Lanes> transposed(__m256d a, __m256d b, __m256d c, __m256d d) {
  const __m256d ab_low = _mm256_unpacklo_pd(a, b), ab_high = _mm256_unpackhi_pd(a, b);
  const __m256d cd_low = _mm256_unpacklo_pd(c, d), cd_high = _mm256_unpackhi_pd(c, d);
  return {_mm256_permute2f128_pd(ab_low, cd_low, 0x20), _mm256_permute2f128_pd(ab_high, cd_high, 0x20),
          _mm256_permute2f128_pd(ab_low, cd_low, 0x31)};
}

inline continuous::Triple<Lanes> Lanes::points(const float* const (&at)[kWidth]) {
  const auto wide = [&](int k) { return _mm256_cvtps_pd(_mm_loadu_ps(at[k])); };
  return transposed(wide(0), wide(1), wide(2), wide(3));
}

inline continuous::Triple<Lanes> Lanes::points(const double* const (&at)[kWidth]) {
  const __m256i three = _mm256_set_epi64x(0, -1, -1, -1);
  const auto column = [&](int k) { return _mm256_maskload_pd(at[k], three); };
  return transposed(column(0), column(1), column(2), column(3));
}

}  // namespace avx2

constexpr ImpactKernels kAvx2Kernels = kernels_of<avx2::Lanes>();

}  // namespace broadside::reference

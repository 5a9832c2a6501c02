// Eight doubles side by side, with the operations of core/continuous/lane_math.hpp: the result in each lane has the
// same bits as with a single double.
#include <immintrin.h>

#include "core/continuous/lane_math.hpp"
#include "reference/continuous/impact_kernel.hpp"

namespace broadside::reference {
namespace avx512 {

struct Mask {
  __mmask8 bits;

  friend Mask operator&(Mask a, Mask b) { return {_kand_mask8(a.bits, b.bits)}; }
  friend Mask operator|(Mask a, Mask b) { return {_kor_mask8(a.bits, b.bits)}; }
  friend Mask operator!(Mask a) { return {_knot_mask8(a.bits)}; }
  // Bit k is lane k.
  [[nodiscard]] unsigned lanes() const { return bits; }
};

inline bool any(Mask a) {
  return a.bits != 0;
}

struct Lanes {
  static constexpr int kWidth = 8;
  __m512d v;

  Lanes() : v(_mm512_setzero_pd()) {}
  Lanes(__m512d given) : v(given) {}
  Lanes(double x) : v(_mm512_set1_pd(x)) {}

  friend Lanes operator+(Lanes a, Lanes b) { return _mm512_add_pd(a.v, b.v); }
  friend Lanes operator-(Lanes a, Lanes b) { return _mm512_sub_pd(a.v, b.v); }
  friend Lanes operator*(Lanes a, Lanes b) { return _mm512_mul_pd(a.v, b.v); }
  friend Lanes operator/(Lanes a, Lanes b) { return _mm512_div_pd(a.v, b.v); }
  friend Mask operator<(Lanes a, Lanes b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ)}; }
  friend Mask operator<=(Lanes a, Lanes b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_LE_OQ)}; }
  friend Mask operator>(Lanes a, Lanes b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_GT_OQ)}; }
  friend Mask operator>=(Lanes a, Lanes b) { return {_mm512_cmp_pd_mask(a.v, b.v, _CMP_GE_OQ)}; }

  // Loads as many points as there are lanes, each of three doubles, or of four floats of which the last one is ignored.
  static continuous::Triple<Lanes> points(const double* const (&at)[kWidth]);
  static continuous::Triple<Lanes> points(const float* const (&at)[kWidth]);

  static Lanes load(const double* from) { return _mm512_loadu_pd(from); }
  void store(double* to) const { _mm512_storeu_pd(to, v); }
};

inline Lanes pick(Mask is_first, Lanes first, Lanes second) {
  return _mm512_mask_blend_pd(is_first.bits, second.v, first.v);
}
inline Lanes magnitude(Lanes x) {
  return _mm512_abs_pd(x.v);
}
// min and max give the second argument where neither is less: as a < b ? a : b.
inline Lanes lesser(Lanes a, Lanes b) {
  return _mm512_min_pd(a.v, b.v);
}
inline Lanes larger(Lanes a, Lanes b) {
  return _mm512_max_pd(a.v, b.v);
}

// The first three rows of a matrix of eight columns. Each argument holds two columns: k and k + 4.
inline continuous::Triple<Lanes> transposed(__m512d a, __m512d b, __m512d c, __m512d d) {
  const __m512d ab_low = _mm512_unpacklo_pd(a, b), ab_high = _mm512_unpackhi_pd(a, b);
  const __m512d cd_low = _mm512_unpacklo_pd(c, d), cd_high = _mm512_unpackhi_pd(c, d);
  // Each register holds pairs of two rows (x and z, or y and w) of columns 0 1 4 5 or 2 3 6 7. Gathers one row of all
  // columns, in order.
  const __m512i low = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0);
  const __m512i high = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
  return {_mm512_permutex2var_pd(ab_low, low, cd_low), _mm512_permutex2var_pd(ab_high, low, cd_high),
          _mm512_permutex2var_pd(ab_low, high, cd_low)};
}

inline continuous::Triple<Lanes> Lanes::points(const float* const (&at)[kWidth]) {
  const auto two = [&](int k) {
    const __m256 both = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(at[k])), _mm_loadu_ps(at[k + 4]), 1);
    return _mm512_cvtps_pd(both);
  };
  return transposed(two(0), two(1), two(2), two(3));
}

inline continuous::Triple<Lanes> Lanes::points(const double* const (&at)[kWidth]) {
  const auto two = [&](int k) {
    const __m512d first = _mm512_maskz_loadu_pd(0x07, at[k]);
    return _mm512_mask_loadu_pd(first, 0x70, at[k + 4] - 4);
  };
  return transposed(two(0), two(1), two(2), two(3));
}

}  // namespace avx512

constexpr ImpactKernels kAvx512Kernels = kernels_of<avx512::Lanes>();

}  // namespace broadside::reference

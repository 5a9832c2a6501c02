// Eight floats in one register.
#include <immintrin.h>

#include "reference/octree_cpu/rigid/patch_kernel.hpp"

namespace broadside::reference {
namespace patch_avx2 {

struct Truth {
  __m256 bits;

  Truth() : bits(_mm256_setzero_ps()) {}
  Truth(__m256 given) : bits(given) {}
  Truth(bool all) : bits(_mm256_castsi256_ps(_mm256_set1_epi32(all ? -1 : 0))) {}

  friend Truth operator&(Truth a, Truth b) { return _mm256_and_ps(a.bits, b.bits); }
  friend Truth operator|(Truth a, Truth b) { return _mm256_or_ps(a.bits, b.bits); }
  friend Truth operator!(Truth a) { return _mm256_xor_ps(a.bits, Truth(true).bits); }
  // Bit k is lane k.
  static Truth of_lanes(unsigned lanes) {
    const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i found = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(lanes)), bit);
    return _mm256_castsi256_ps(_mm256_cmpeq_epi32(found, bit));
  }
  friend unsigned lanes_of(Truth a) { return static_cast<unsigned>(_mm256_movemask_ps(a.bits)); }
  friend bool any(Truth a) { return _mm256_movemask_ps(a.bits) != 0; }

  void set(std::uint32_t lane, bool truth) { reinterpret_cast<std::int32_t*>(&bits)[lane] = truth ? -1 : 0; }
  [[nodiscard]] bool get(std::uint32_t lane) const { return (lanes_of(*this) >> lane & 1U) != 0; }
};

struct Lanes {
  using Truth = patch_avx2::Truth;
  __m256 v;

  Lanes() : v(_mm256_setzero_ps()) {}
  Lanes(__m256 given) : v(given) {}
  Lanes(float x) : v(_mm256_set1_ps(x)) {}

  friend Lanes operator+(Lanes a, Lanes b) { return _mm256_add_ps(a.v, b.v); }
  friend Lanes operator-(Lanes a, Lanes b) { return _mm256_sub_ps(a.v, b.v); }
  friend Lanes operator*(Lanes a, Lanes b) { return _mm256_mul_ps(a.v, b.v); }
  friend Lanes operator/(Lanes a, Lanes b) { return _mm256_div_ps(a.v, b.v); }
  friend Lanes operator-(Lanes a) { return _mm256_xor_ps(a.v, _mm256_set1_ps(-0.0F)); }
  friend Truth operator<(Lanes a, Lanes b) { return _mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ); }
  friend Truth operator>(Lanes a, Lanes b) { return _mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ); }
  friend Lanes pick(Truth is_first, Lanes first, Lanes second) {
    return _mm256_blendv_ps(second.v, first.v, is_first.bits);
  }
  friend Truth has_sign(Lanes a) { return _mm256_castsi256_ps(_mm256_srai_epi32(_mm256_castps_si256(a.v), 31)); }
  friend Lanes square_root(Lanes a) { return _mm256_sqrt_ps(a.v); }
  friend Lanes plus_product(Lanes sum, Lanes a, Lanes b) { return _mm256_fmadd_ps(a.v, b.v, sum.v); }
  friend Lanes less_product(Lanes sum, Lanes a, Lanes b) { return _mm256_fnmadd_ps(a.v, b.v, sum.v); }
  friend Lanes rough_reciprocal_root(Lanes a) {
    const __m256i seed = _mm256_set1_epi32(static_cast<int>(core::kReciprocalRootBits));
    return _mm256_castsi256_ps(_mm256_sub_epi32(seed, _mm256_srli_epi32(_mm256_castps_si256(a.v), 1)));
  }
  // Over lanes that are not NaN; at least 0.
  friend float largest_of(Lanes a) {
    float lanes[kTileLanes];
    a.store(lanes);
    float largest = 0.0F;
    for (const float x : lanes) largest = x > largest ? x : largest;
    return largest;
  }

  void store(float* to) const { _mm256_storeu_ps(to, v); }
  void set(std::uint32_t lane, float x) { reinterpret_cast<float*>(&v)[lane] = x; }
  [[nodiscard]] float get(std::uint32_t lane) const { return reinterpret_cast<const float*>(&v)[lane]; }

  // Four rows of eight columns, and back: a column is a word of four floats.
  static void transpose(__m256 (&m)[4]) {
    const __m256 low_01 = _mm256_unpacklo_ps(m[0], m[1]), high_01 = _mm256_unpackhi_ps(m[0], m[1]);
    const __m256 low_23 = _mm256_unpacklo_ps(m[2], m[3]), high_23 = _mm256_unpackhi_ps(m[2], m[3]);
    m[0] = _mm256_shuffle_ps(low_01, low_23, 0x44);
    m[1] = _mm256_shuffle_ps(low_01, low_23, 0xEE);
    m[2] = _mm256_shuffle_ps(high_01, high_23, 0x44);
    m[3] = _mm256_shuffle_ps(high_01, high_23, 0xEE);
  }
  static void load_words(const float* const (&from)[kTileLanes], int first, Lanes& x, Lanes& y, Lanes& z, Lanes& w) {
    __m256 m[4];
    for (int k = 0; k < 4; ++k)
      m[k] = _mm256_set_m128(_mm_loadu_ps(from[k + 4] + first), _mm_loadu_ps(from[k] + first));
    transpose(m);
    x.v = m[0];
    y.v = m[1];
    z.v = m[2];
    w.v = m[3];
  }
  // For lanes whose bit is set.
  static void store_words(float* const (&to)[kTileLanes], int first, unsigned which, Lanes x, Lanes y, Lanes z,
                          Lanes w) {
    __m256 m[4] = {x.v, y.v, z.v, w.v};
    transpose(m);
    for (int k = 0; k < 4; ++k) {
      if ((which >> k & 1U) != 0) _mm_storeu_ps(to[k] + first, _mm256_castps256_ps128(m[k]));
      if ((which >> (k + 4) & 1U) != 0) _mm_storeu_ps(to[k + 4] + first, _mm256_extractf128_ps(m[k], 1));
    }
  }
};

}  // namespace patch_avx2

const PatchKernels kAvx2PatchKernels = tiles::kernels_of<patch_avx2::Lanes>("avx2");

}  // namespace broadside::reference

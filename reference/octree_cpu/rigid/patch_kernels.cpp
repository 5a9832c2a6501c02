// Eight floats in two vectors of four, which every machine's compiler supports.
#include "reference/octree_cpu/rigid/patch_kernels.hpp"

#include <cmath>
#include <cstring>

#include "reference/octree_cpu/rigid/patch_kernel.hpp"

namespace broadside::reference {
namespace portable {

using Four = float __attribute__((vector_size(16)));
using FourBits = std::int32_t __attribute__((vector_size(16)));
constexpr std::uint32_t kHalf = 4;

struct Truth {
  FourBits low{};
  FourBits high{};

  Truth() = default;
  Truth(FourBits l, FourBits h) : low(l), high(h) {}
  Truth(bool all) : low(FourBits{} - (all ? 1 : 0)), high(low) {}

  friend Truth operator&(const Truth& a, const Truth& b) { return {a.low & b.low, a.high & b.high}; }
  friend Truth operator|(const Truth& a, const Truth& b) { return {a.low | b.low, a.high | b.high}; }
  friend Truth operator!(const Truth& a) { return {~a.low, ~a.high}; }
  // Bit k is lane k.
  static Truth of_lanes(unsigned lanes) {
    Truth truth;
    for (std::uint32_t k = 0; k < kTileLanes; ++k) truth.set(k, (lanes >> k & 1U) != 0);
    return truth;
  }
  friend unsigned lanes_of(const Truth& a) {
    unsigned lanes = 0;
    for (std::uint32_t k = 0; k < kTileLanes; ++k) lanes |= (a.get(k) ? 1U : 0U) << k;
    return lanes;
  }
  friend bool any(const Truth& a) {
    const FourBits either = a.low | a.high;
    return (either[0] | either[1] | either[2] | either[3]) != 0;
  }

  void set(std::uint32_t lane, bool truth) { (lane < kHalf ? low : high)[lane % kHalf] = truth ? -1 : 0; }
  [[nodiscard]] bool get(std::uint32_t lane) const { return (lane < kHalf ? low : high)[lane % kHalf] != 0; }
};

inline Four plus_product(Four sum, Four a, Four b) {
  Four out;
  for (int k = 0; k < 4; ++k) out[k] = core::plus_product(sum[k], a[k], b[k]);
  return out;
}
inline Four root(Four x) {
  return Four{sqrtf(x[0]), sqrtf(x[1]), sqrtf(x[2]), sqrtf(x[3])};
}
inline FourBits signs_of(Four x) {
  FourBits bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits >> 31;
}
inline Four chosen(FourBits is_first, Four first, Four second) {
  FourBits a, b;
  std::memcpy(&a, &first, sizeof a);
  std::memcpy(&b, &second, sizeof b);
  const FourBits bits = (is_first & a) | (~is_first & b);
  Four out;
  std::memcpy(&out, &bits, sizeof out);
  return out;
}

struct Lanes {
  using Truth = portable::Truth;
  Four low{};
  Four high{};

  Lanes() = default;
  Lanes(Four l, Four h) : low(l), high(h) {}
  Lanes(float x) : low{x, x, x, x}, high(low) {}

  friend Lanes operator+(const Lanes& a, const Lanes& b) { return {a.low + b.low, a.high + b.high}; }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return {a.low - b.low, a.high - b.high}; }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return {a.low * b.low, a.high * b.high}; }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return {a.low / b.low, a.high / b.high}; }
  friend Lanes operator-(const Lanes& a) { return {-a.low, -a.high}; }
  friend Truth operator<(const Lanes& a, const Lanes& b) { return {a.low < b.low, a.high < b.high}; }
  friend Truth operator>(const Lanes& a, const Lanes& b) { return {a.low > b.low, a.high > b.high}; }
  friend Lanes pick(const Truth& is_first, const Lanes& first, const Lanes& second) {
    return {chosen(is_first.low, first.low, second.low), chosen(is_first.high, first.high, second.high)};
  }
  friend Truth has_sign(const Lanes& a) { return {signs_of(a.low), signs_of(a.high)}; }
  friend Lanes square_root(const Lanes& a) { return {root(a.low), root(a.high)}; }
  friend Lanes plus_product(const Lanes& sum, const Lanes& a, const Lanes& b) {
    return {plus_product(sum.low, a.low, b.low), plus_product(sum.high, a.high, b.high)};
  }
  friend Lanes less_product(const Lanes& sum, const Lanes& a, const Lanes& b) {
    return {plus_product(sum.low, -a.low, b.low), plus_product(sum.high, -a.high, b.high)};
  }
  friend Lanes rough_reciprocal_root(const Lanes& a) {
    Lanes rough;
    for (std::uint32_t k = 0; k < kTileLanes; ++k) rough.set(k, core::rough_reciprocal_root(a.get(k)));
    return rough;
  }
  // Over lanes that are not NaN; at least 0.
  friend float largest_of(const Lanes& a) {
    float largest = 0.0F;
    for (std::uint32_t k = 0; k < kTileLanes; ++k) largest = a.get(k) > largest ? a.get(k) : largest;
    return largest;
  }

  static Lanes load(const float* from) {
    Lanes x;
    std::memcpy(&x.low, from, sizeof low);
    std::memcpy(&x.high, from + kHalf, sizeof high);
    return x;
  }
  void store(float* to) const {
    std::memcpy(to, &low, sizeof low);
    std::memcpy(to + kHalf, &high, sizeof high);
  }
  void set(std::uint32_t lane, float x) { (lane < kHalf ? low : high)[lane % kHalf] = x; }
  [[nodiscard]] float get(std::uint32_t lane) const { return (lane < kHalf ? low : high)[lane % kHalf]; }

  static void load_words(const float* const (&from)[kTileLanes], int first, Lanes& x, Lanes& y, Lanes& z, Lanes& w) {
    float columns[4][kTileLanes];
    for (std::uint32_t k = 0; k < kTileLanes; ++k)
      for (int row = 0; row < 4; ++row) columns[row][k] = from[k][first + row];
    x = load(columns[0]);
    y = load(columns[1]);
    z = load(columns[2]);
    w = load(columns[3]);
  }
  // For lanes whose bit is set.
  static void store_words(float* const (&to)[kTileLanes], int first, unsigned which, const Lanes& x, const Lanes& y,
                          const Lanes& z, const Lanes& w) {
    float columns[4][kTileLanes];
    x.store(columns[0]);
    y.store(columns[1]);
    z.store(columns[2]);
    w.store(columns[3]);
    for (std::uint32_t k = 0; k < kTileLanes; ++k)
      for (int row = 0; row < 4 && (which >> k & 1U) != 0; ++row) to[k][first + row] = columns[row][k];
  }
};

}  // namespace portable

namespace {

const PatchKernels kPortablePatchKernels = tiles::kernels_of<portable::Lanes>("portable");

}  // namespace

std::span<const PatchKernels* const> all_patch_kernels() {
#ifdef BROADSIDE_HAS_AVX2_KERNEL
  static const PatchKernels* const kAll[] = {&kAvx2PatchKernels, &kPortablePatchKernels};
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 ? std::span(kAll)
                                                                                   : std::span(kAll).subspan(1);
#else
  static const PatchKernels* const kAll[] = {&kPortablePatchKernels};
  return kAll;
#endif
}

}  // namespace broadside::reference

// Sums with a product that is not rounded on its own: one operation instead of two, and one rounding. Formulas ask for
// them by name, so that every machine computes the same bits; the compiler never chooses them (-ffp-contract=off,
// --fmad=false).
//
// Where the host's processor has no such instruction, or the compiler may not use it, fmaf is a function call. Loops
// over millions of patches use vector lanes instead (reference/octree_cpu/rigid/patch_kernel.hpp).
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

// sum + a b, and sum - a b.
BROADSIDE_HD float plus_product(float sum, float a, float b) {
  return fmaf(a, b, sum);
}
BROADSIDE_HD float less_product(float sum, float a, float b) {
  return fmaf(-a, b, sum);
}

// sum + s v, component by component.
template <typename Vector, typename Number>
BROADSIDE_HD Vector plus_times(const Vector& sum, const Number& s, const Vector& v) {
  return {plus_product(sum.x, s, v.x), plus_product(sum.y, s, v.y), plus_product(sum.z, s, v.z)};
}
template <typename Vector, typename Number>
BROADSIDE_HD Vector less_times(const Vector& sum, const Number& s, const Vector& v) {
  return {less_product(sum.x, s, v.x), less_product(sum.y, s, v.y), less_product(sum.z, s, v.z)};
}

template <typename Vector>
BROADSIDE_HD auto fused_dot(const Vector& a, const Vector& b) {
  return plus_product(plus_product(a.x * b.x, a.y, b.y), a.z, b.z);
}

// sum + a x b.
template <typename Vector>
BROADSIDE_HD Vector plus_cross(const Vector& sum, const Vector& a, const Vector& b) {
  return {less_product(plus_product(sum.x, a.y, b.z), a.z, b.y), less_product(plus_product(sum.y, a.z, b.x), a.x, b.z),
          less_product(plus_product(sum.z, a.x, b.y), a.y, b.x)};
}

// M v, where M is a symmetric matrix.
template <typename Symmetric, typename Vector>
BROADSIDE_HD Vector fused_product(const Symmetric& m, const Vector& v) {
  return {plus_product(plus_product(m.xx * v.x, m.xy, v.y), m.xz, v.z),
          plus_product(plus_product(m.xy * v.x, m.yy, v.y), m.yz, v.z),
          plus_product(plus_product(m.xz * v.x, m.yz, v.y), m.zz, v.z)};
}

// 1 / sqrt(x) within 4 %, from the bits of a positive normal number: half of the exponent with its sign reversed
// (Lomont, Fast inverse square root, 2003).
inline constexpr std::uint32_t kReciprocalRootBits = 0x5F3759DFU;
BROADSIDE_HD constexpr float rough_reciprocal_root(float x) {
  return std::bit_cast<float>(kReciprocalRootBits - (std::bit_cast<std::uint32_t>(x) >> 1));
}

// 1 / sqrt(x) to within a few of its last bits, by three Newton steps. Below the least normal number the result is too
// small, and at 0 it is finite.
template <typename Number>
BROADSIDE_HD Number reciprocal_root(const Number& x) {
  const Number half = 0.5F * x;
  Number y = rough_reciprocal_root(x);
  for (int k = 0; k < 3; ++k) y = plus_product(y, y, less_product(Number(0.5F), half * y, y));
  return y;
}

// sqrt(x), and 1 / x, of a positive normal number, as accurate as that; sqrt(0) is 0.
template <typename Number>
BROADSIDE_HD Number near_root(const Number& x) {
  return x * reciprocal_root<Number>(x);
}
template <typename Number>
BROADSIDE_HD Number near_reciprocal(const Number& x) {
  const Number y = reciprocal_root<Number>(x);
  return y * y;
}

}  // namespace broadside::core

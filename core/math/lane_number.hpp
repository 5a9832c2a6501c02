// The operations that a formula needs of a number type, so that one source serves a float, on host and device, and
// several floats side by side in a vector register (reference/octree_cpu/rigid/lanes.hpp): the same operations, and so
// the same bits.
//
// A lane type has + - * / and comparisons lane by lane, converts from a float, and defines its own pick, any,
// has_sign and square_root. Its name for the result of a comparison is Truth; truths are joined with & and |, and
// negated with !.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

// A choice without a branch.
BROADSIDE_HD constexpr float pick(bool is_first, float first, float second) {
  return is_first ? first : second;
}
BROADSIDE_HD constexpr Vec3 pick(bool is_first, Vec3 first, Vec3 second) {
  return is_first ? first : second;
}
// Whether it is true in any lane.
BROADSIDE_HD constexpr bool any(bool truth) {
  return truth;
}
// Whether the sign bit is set: of negative numbers and of -0.
BROADSIDE_HD bool has_sign(float x) {
  return copysignf(1.0F, x) < 0.0F;
}
BROADSIDE_HD float square_root(float x) {
  return sqrtf(x);
}

// A Vec3 with several values side by side; every operation is in the same order as for Vec3.
template <typename Lanes>
struct LaneVec3 {
  Lanes x{0.0F};
  Lanes y{0.0F};
  Lanes z{0.0F};

  friend LaneVec3 operator+(const LaneVec3& a, const LaneVec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend LaneVec3 operator-(const LaneVec3& a, const LaneVec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend LaneVec3 operator*(const Lanes& s, const LaneVec3& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend Lanes dot(const LaneVec3& a, const LaneVec3& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
  friend LaneVec3 cross(const LaneVec3& a, const LaneVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend LaneVec3 pick(const typename Lanes::Truth& is_first, const LaneVec3& first, const LaneVec3& second) {
    return {pick(is_first, first.x, second.x), pick(is_first, first.y, second.y), pick(is_first, first.z, second.z)};
  }
};

// The vector and truth types that belong to a number type.
template <typename Number>
struct NumberTraits {
  using Vector = LaneVec3<Number>;
  using Truth = typename Number::Truth;
};
template <>
struct NumberTraits<float> {
  using Vector = Vec3;
  using Truth = bool;
};
template <typename Number>
using VectorOf = typename NumberTraits<Number>::Vector;
template <typename Number>
using TruthOf = typename NumberTraits<Number>::Truth;

}  // namespace broadside::core

// The operations that formulas of continuous collision need of a number type. One source then serves a double on host
// and device and several doubles side by side in a vector register (reference/continuous/), with the same operations
// and so the same bits.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/math/vec3d.hpp"

namespace broadside::continuous {

// A choice without a branch. Conditions are joined with & and |, and negated with !.
BROADSIDE_HD double pick(bool is_first, double first, double second) {
  return is_first ? first : second;
}
BROADSIDE_HD double magnitude(double x) {
  return fabs(x);
}
BROADSIDE_HD double lesser(double a, double b) {
  return a < b ? a : b;
}
BROADSIDE_HD double larger(double a, double b) {
  return a > b ? a : b;
}
BROADSIDE_HD bool any(bool is_true) {
  return is_true;
}

template <typename Real>
BROADSIDE_HD Real within_unit(const Real& x) {
  return lesser(larger(x, Real(0.0)), Real(1.0));
}

template <typename Real>
struct Triple {
  Real x{0.0}, y{0.0}, z{0.0};
};

template <typename Real>
BROADSIDE_HD Triple<Real> operator+(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <typename Real>
BROADSIDE_HD Triple<Real> operator-(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <typename Real>
BROADSIDE_HD Triple<Real> operator*(const Real& s, const Triple<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
// The three products are added left to right: the order is part of the result's bits.
template <typename Real>
BROADSIDE_HD Real dot(const Triple<Real>& a, const Triple<Real>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <typename Real>
BROADSIDE_HD Triple<Real> cross(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename Mask, typename Real>
BROADSIDE_HD Triple<Real> pick(const Mask& is_first, const Triple<Real>& a, const Triple<Real>& b) {
  return {pick(is_first, a.x, b.x), pick(is_first, a.y, b.y), pick(is_first, a.z, b.z)};
}
template <typename Real>
BROADSIDE_HD Triple<Real> magnitude(const Triple<Real>& a) {
  return {magnitude(a.x), magnitude(a.y), magnitude(a.z)};
}
template <typename Real>
BROADSIDE_HD Triple<Real> lesser(const Triple<Real>& a, const Triple<Real>& b) {
  return {lesser(a.x, b.x), lesser(a.y, b.y), lesser(a.z, b.z)};
}
template <typename Real>
BROADSIDE_HD Triple<Real> larger(const Triple<Real>& a, const Triple<Real>& b) {
  return {larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z)};
}

BROADSIDE_HD Triple<double> triple(core::Vec3d v) {
  return {v.x, v.y, v.z};
}

}  // namespace broadside::continuous

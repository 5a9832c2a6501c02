// A vector of three doubles for host and device: places of moving points, m.
#pragma once

#include <cmath>

#include "core/attributes.hpp"

namespace broadside::core {

struct Vec3d {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  BROADSIDE_HD constexpr double operator[](int axis) const { return axis == 0 ? x : (axis == 1 ? y : z); }
  BROADSIDE_HD constexpr double& operator[](int axis) { return axis == 0 ? x : (axis == 1 ? y : z); }
  friend constexpr bool operator==(const Vec3d&, const Vec3d&) = default;
};

BROADSIDE_HD constexpr Vec3d operator+(Vec3d a, Vec3d b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
BROADSIDE_HD constexpr Vec3d operator-(Vec3d a, Vec3d b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
BROADSIDE_HD constexpr Vec3d operator*(double s, Vec3d a) {
  return {s * a.x, s * a.y, s * a.z};
}

// The three products are added left to right: the order is part of the result's bits.
BROADSIDE_HD constexpr double dot(Vec3d a, Vec3d b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
BROADSIDE_HD constexpr Vec3d cross(Vec3d a, Vec3d b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// The largest absolute value of the components.
BROADSIDE_HD double largest_of(Vec3d a) {
  return fmax(fmax(fabs(a.x), fabs(a.y)), fabs(a.z));
}

}  // namespace broadside::core

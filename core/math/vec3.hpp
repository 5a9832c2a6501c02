// A vector of three floats: the state's precision (float32), in SI units and the world frame unless said otherwise.
#pragma once

#include <cmath>

#include "core/attributes.hpp"

namespace broadside::core {

struct Vec3 {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;

  BROADSIDE_HD constexpr float operator[](int axis) const { return axis == 0 ? x : (axis == 1 ? y : z); }
  BROADSIDE_HD constexpr float& operator[](int axis) { return axis == 0 ? x : (axis == 1 ? y : z); }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

BROADSIDE_HD constexpr Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
BROADSIDE_HD constexpr Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
BROADSIDE_HD constexpr Vec3 operator*(float s, Vec3 a) {
  return {s * a.x, s * a.y, s * a.z};
}

// The three products are added left to right: the order is part of the result's bits.
BROADSIDE_HD constexpr float dot(Vec3 a, Vec3 b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

BROADSIDE_HD float length(Vec3 a) {
  return sqrtf(dot(a, a));
}

BROADSIDE_HD constexpr Vec3 axis_vector(int axis, float sign) {
  return {axis == 0 ? sign : 0.0F, axis == 1 ? sign : 0.0F, axis == 2 ? sign : 0.0F};
}

}  // namespace broadside::core

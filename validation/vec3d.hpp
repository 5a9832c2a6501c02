// A vector of three doubles: what validators compute with. Every float32 converts to it exactly.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/math/vec3.hpp"

namespace broadside::validation {

struct Vec3d {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  constexpr Vec3d() = default;
  constexpr Vec3d(double px, double py, double pz) : x(px), y(py), z(pz) {}
  constexpr explicit Vec3d(core::Vec3 v) : x(v.x), y(v.y), z(v.z) {}

  constexpr double operator[](int axis) const { return axis == 0 ? x : (axis == 1 ? y : z); }
};

constexpr Vec3d operator+(Vec3d a, Vec3d b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3d operator-(Vec3d a, Vec3d b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3d operator*(double s, Vec3d a) {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr double dot(Vec3d a, Vec3d b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double length(Vec3d a) {
  return std::sqrt(dot(a, a));
}

// Largest component by magnitude; NaN when any component is.
inline double largest_component(Vec3d a) {
  const double sum = a.x + a.y + a.z;
  if (std::isnan(sum)) return sum;
  return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

inline bool is_finite(core::Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace broadside::validation

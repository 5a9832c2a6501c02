// Matrices and quaternions of doubles: what the laws of mechanics compute with.
#pragma once

#include <array>
#include <cmath>

#include "core/math/quat.hpp"
#include "core/math/wide.hpp"
#include "validation/vec3d.hpp"

namespace broadside::validation {

constexpr Vec3d cross(Vec3d a, Vec3d b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Rows.
struct Mat3d {
  std::array<Vec3d, 3> row;
};

constexpr Vec3d operator*(const Mat3d& m, Vec3d v) {
  return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
// The transpose times v.
constexpr Vec3d transposed_times(const Mat3d& m, Vec3d v) {
  return v.x * m.row[0] + v.y * m.row[1] + v.z * m.row[2];
}

// Of a matrix that can be inverted.
constexpr Mat3d inverse(const Mat3d& m) {
  const Vec3d a = cross(m.row[1], m.row[2]);
  const Vec3d b = cross(m.row[2], m.row[0]);
  const Vec3d c = cross(m.row[0], m.row[1]);
  const double s = 1.0 / dot(m.row[0], a);
  return {{s * Vec3d{a.x, b.x, c.x}, s * Vec3d{a.y, b.y, c.y}, s * Vec3d{a.z, b.z, c.z}}};
}

// w + xi + yj + zk, world from body.
struct Quatd {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

constexpr Quatd to_quatd(core::Quat q) {
  return {q.w, q.x, q.y, q.z};
}
constexpr Quatd to_quatd(core::WideQuat q) {
  return {q.w, q.x, q.y, q.z};
}
constexpr double squared_norm(Quatd q) {
  return (q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z);
}
inline Quatd normalized(Quatd q) {
  const double s = 1.0 / std::sqrt(squared_norm(q));
  return {s * q.w, s * q.x, s * q.y, s * q.z};
}
constexpr Quatd conjugate(Quatd q) {
  return {q.w, -q.x, -q.y, -q.z};
}
constexpr Quatd operator*(Quatd p, Quatd q) {
  return {p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
          p.w * q.y + p.y * q.w + p.z * q.x - p.x * q.z, p.w * q.z + p.z * q.w + p.x * q.y - p.y * q.x};
}
// The turn by the rotation vector (rad).
inline Quatd turn_by(Vec3d rotation) {
  const double angle = length(rotation);
  if (angle == 0.0) return {};
  const double s = std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), s * rotation.x, s * rotation.y, s * rotation.z};
}
// Angle of the turn, 0 to pi.
inline double angle_of(Quatd q) {
  return 2.0 * std::atan2(std::sqrt((q.x * q.x + q.y * q.y) + q.z * q.z), std::abs(q.w));
}
inline Mat3d matrix_of(Quatd unit) {
  const auto [w, x, y, z] = unit;
  return {{Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           Vec3d{2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           Vec3d{2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

}  // namespace broadside::validation

// Vectors, matrices and quaternions of doubles for plain-rigid. World frame and SI units unless said otherwise.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace broadside::reference::plain {

struct Vec {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  [[nodiscard]] double operator[](int axis) const { return axis == 0 ? x : (axis == 1 ? y : z); }
  [[nodiscard]] double& operator[](int axis) { return axis == 0 ? x : (axis == 1 ? y : z); }
};

inline Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator-(Vec a) {
  return {-a.x, -a.y, -a.z};
}
inline Vec operator*(double s, Vec a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(Vec a, Vec b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
inline Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec a) {
  return std::sqrt(dot(a, a));
}
inline Vec axis_of(int axis) {
  return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
}
// Some unit vector at right angles to the unit vector n.
inline Vec perpendicular(Vec n) {
  const Vec other = std::abs(n.x) < 0.6 ? Vec{1, 0, 0} : Vec{0, 1, 0};
  const Vec t = cross(n, other);
  return (1.0 / length(t)) * t;
}

// Rows of a 3 x 3 matrix.
struct Mat {
  std::array<Vec, 3> row{Vec{1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1}};
};

inline Vec operator*(const Mat& m, Vec v) {
  return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
inline Mat transposed(const Mat& m) {
  return {{Vec{m.row[0].x, m.row[1].x, m.row[2].x}, Vec{m.row[0].y, m.row[1].y, m.row[2].y},
           Vec{m.row[0].z, m.row[1].z, m.row[2].z}}};
}
inline Vec column(const Mat& m, int k) {
  return {m.row[0][k], m.row[1][k], m.row[2][k]};
}
inline Mat operator*(const Mat& a, const Mat& b) {
  const Mat t = transposed(b);
  Mat out;
  for (std::size_t i = 0; i < 3; ++i)
    out.row[i] = {dot(a.row[i], t.row[0]), dot(a.row[i], t.row[1]), dot(a.row[i], t.row[2])};
  return out;
}
// The inverse of a matrix that has one.
inline Mat inverse(const Mat& m) {
  const Vec a = cross(m.row[1], m.row[2]);
  const Vec b = cross(m.row[2], m.row[0]);
  const Vec c = cross(m.row[0], m.row[1]);
  const double s = 1.0 / dot(m.row[0], a);
  return transposed({{s * a, s * b, s * c}});
}

// w + xi + yj + zk, world from body.
struct Quaternion {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

inline Quaternion normalized(Quaternion q) {
  const double s = 1.0 / std::sqrt((q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z));
  return {s * q.w, s * q.x, s * q.y, s * q.z};
}

// q changed by s times the rate of change that the angular velocity w (world) gives to `at`: dq/dt = (0, w) q / 2.
inline Quaternion moved(Quaternion q, Quaternion at, Vec w, double s) {
  const double h = 0.5 * s;
  return {q.w - h * (w.x * at.x + w.y * at.y + w.z * at.z), q.x + h * (w.x * at.w + w.y * at.z - w.z * at.y),
          q.y + h * (w.y * at.w + w.z * at.x - w.x * at.z), q.z + h * (w.z * at.w + w.x * at.y - w.y * at.x)};
}

// The rotation matrix, also for a quaternion whose length is not quite 1.
inline Mat matrix(Quaternion given) {
  const Quaternion q = normalized(given);
  return {{Vec{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.w * q.z), 2 * (q.x * q.z + q.w * q.y)},
           Vec{2 * (q.x * q.y + q.w * q.z), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z - q.w * q.x)},
           Vec{2 * (q.x * q.z - q.w * q.y), 2 * (q.y * q.z + q.w * q.x), 1 - 2 * (q.x * q.x + q.y * q.y)}}};
}

}  // namespace broadside::reference::plain

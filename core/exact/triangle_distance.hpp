// The least distance between two triangles, in double: the basis of the exact distance between meshes.
#pragma once

#include <array>
#include <cmath>

#include "core/math/vec3.hpp"

namespace broadside::exact {

struct Point {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

constexpr Point to_point(core::Vec3 v) {
  return {v.x, v.y, v.z};
}
constexpr Point operator+(Point a, Point b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Point operator*(double s, Point a) {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double length(Point a) {
  return std::sqrt(dot(a, a));
}
constexpr Point cross(Point a, Point b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

using Corners = std::array<Point, 3>;

// Nearest points of two bodies or triangles, in the frame of the corners, m. A squared distance of 0 means that they
// meet; then both points are one common point.
struct Nearest {
  double squared_m2 = 0.0;
  Point on_a;
  Point on_b;
};

// Degenerate triangles (segments, points) are allowed. The squared distance is 0 exactly when the closed triangles have
// a point in common, as exact predicates decide (core/exact/predicates.hpp). When they have none but rounding would
// give 0, it is the least positive number. For two edges within an angle t of parallel, with t < 1e-8 or so, the
// distance may be off by t times their length.
Nearest nearest_of_triangles(const Corners& a, const Corners& b);

// on_a is the point itself.
Nearest nearest_of_point_and_triangle(Point p, const Corners& t);

// Segments p0 p1 and q0 q1, which may be points.
Nearest nearest_of_segments(Point p0, Point p1, Point q0, Point q1);

}  // namespace broadside::exact

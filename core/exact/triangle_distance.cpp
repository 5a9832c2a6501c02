#include "core/exact/triangle_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/exact/predicates.hpp"

namespace broadside::exact {
namespace {

void keep_nearer(Nearest& best, Point on_a, Point on_b) {
  const Point d = on_a - on_b;
  const double squared = dot(d, d);
  if (squared < best.squared_m2) best = {squared, on_a, on_b};
}

Point nearest_on_segment(Point p, Point from, Point to) {
  const Point along = to - from;
  const double length2 = dot(along, along);
  if (!(length2 > 0.0)) return from;
  return from + std::clamp(dot(p - from, along) / length2, 0.0, 1.0) * along;
}

// The projection of p onto the triangle's plane, when it lies in the triangle. When it lies outside, an edge is
// nearest; the caller tests edges.
bool foot_in_triangle(Point p, const Corners& t, Point& foot) {
  const Point normal = cross(t[1] - t[0], t[2] - t[0]);
  const double normal2 = dot(normal, normal);
  if (!(normal2 > 0.0)) return false;
  foot = p - (dot(p - t[0], normal) / normal2) * normal;
  for (int k = 0; k < 3; ++k)
    if (dot(cross(t[(k + 1) % 3] - t[k], foot - t[k]), normal) < 0.0) return false;
  return true;
}

// Nearest points inside two segments. False when the segments are parallel or the nearest point is an end of one; the
// caller tests these cases.
bool nearest_inside_segments(Point p0, Point p1, Point q0, Point q1, Point& on_p, Point& on_q) {
  const Point u = p1 - p0;
  const Point v = q1 - q0;
  const Point w = p0 - q0;
  const double uu = dot(u, u);
  const double uv = dot(u, v);
  const double vv = dot(v, v);
  const double uw = dot(u, w);
  const double vw = dot(v, w);
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0.0)) return false;
  const double s = (uv * vw - vv * uw) / determinant;
  const double t = (uu * vw - uv * uw) / determinant;
  if (!(s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)) return false;
  on_p = p0 + s * u;
  on_q = q0 + t * v;
  return true;
}

// Finds where the segment passes through the triangle: its ends lie on different sides of the plane, and the line
// passes all three edges on the same side.
bool passes_through(Point from, Point to, const Corners& t, Point& at) {
  const Point normal = cross(t[1] - t[0], t[2] - t[0]);
  const double side_from = dot(from - t[0], normal);
  const double side_to = dot(to - t[0], normal);
  if ((side_from > 0.0) == (side_to > 0.0) || side_from == side_to) return false;
  const Point along = to - from;
  int positive = 0;
  int negative = 0;
  for (int k = 0; k < 3; ++k) {
    const double turn = dot(along, cross(t[k] - from, t[(k + 1) % 3] - from));
    positive += turn > 0.0 ? 1 : 0;
    negative += turn < 0.0 ? 1 : 0;
  }
  if (positive != 0 && negative != 0) return false;
  at = from + (side_from / (side_from - side_to)) * along;
  return true;
}

// When triangles are nearer than this share of the largest coordinate, exact predicates decide whether they meet. The
// rounding of double is 1e-16 of that coordinate; thin triangles lose many of the digits that remain.
constexpr double kDoubt = 1e-7;

double largest_coordinate(const Corners& t) {
  double most = 0.0;
  for (const Point p : t) most = std::max({most, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return most;
}

bool passes_through(const Corners& a, const Corners& b, Point& at) {
  for (int k = 0; k < 3; ++k)
    if (passes_through(a[k], a[(k + 1) % 3], b, at) || passes_through(b[k], b[(k + 1) % 3], a, at)) return true;
  return false;
}

constexpr Nearest kFar{std::numeric_limits<double>::infinity(), {}, {}};

// For triangles that do not cross: the nearest points are of a corner and a face, a corner and an edge, or two edges.
Nearest nearest_of_parts(const Corners& a, const Corners& b) {
  Nearest best = kFar;
  Point on_a;
  Point on_b;
  for (int i = 0; i < 3; ++i) {
    if (foot_in_triangle(a[i], b, on_b)) keep_nearer(best, a[i], on_b);
    if (foot_in_triangle(b[i], a, on_a)) keep_nearer(best, on_a, b[i]);
    for (int j = 0; j < 3; ++j) {
      const Point& a1 = a[(i + 1) % 3];
      const Point& b1 = b[(j + 1) % 3];
      keep_nearer(best, a[i], nearest_on_segment(a[i], b[j], b1));
      keep_nearer(best, nearest_on_segment(b[j], a[i], a1), b[j]);
      if (nearest_inside_segments(a[i], a1, b[j], b1, on_a, on_b)) keep_nearer(best, on_a, on_b);
    }
  }
  return best;
}

}  // namespace

Nearest nearest_of_triangles(const Corners& a, const Corners& b) {
  Point at;
  const bool crosses = passes_through(a, b, at);
  if (crosses && triangles_meet(a, b)) return {0.0, at, at};
  Nearest best = nearest_of_parts(a, b);
  const double doubt = kDoubt * std::max(largest_coordinate(a), largest_coordinate(b));
  if (best.squared_m2 > doubt * doubt) return best;
  if (!crosses && triangles_meet(a, b)) return {0.0, best.on_a, best.on_a};
  best.squared_m2 = std::max(best.squared_m2, std::numeric_limits<double>::min());
  return best;
}

Nearest nearest_of_point_and_triangle(Point p, const Corners& t) {
  Nearest best = kFar;
  Point foot;
  if (foot_in_triangle(p, t, foot)) keep_nearer(best, p, foot);
  for (int k = 0; k < 3; ++k) keep_nearer(best, p, nearest_on_segment(p, t[k], t[(k + 1) % 3]));
  return best;
}

Nearest nearest_of_segments(Point p0, Point p1, Point q0, Point q1) {
  Nearest best = kFar;
  keep_nearer(best, p0, nearest_on_segment(p0, q0, q1));
  keep_nearer(best, p1, nearest_on_segment(p1, q0, q1));
  keep_nearer(best, nearest_on_segment(q0, p0, p1), q0);
  keep_nearer(best, nearest_on_segment(q1, p0, p1), q1);
  Point on_p;
  Point on_q;
  if (nearest_inside_segments(p0, p1, q0, q1, on_p, on_q)) keep_nearer(best, on_p, on_q);
  return best;
}

}  // namespace broadside::exact

// Cylinders for tests, for which the exact arbiter of convex cores has no formula: distances in double by a search over
// directions.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/core/method/rigid/manifold_cases.hpp"

namespace broadside::core {

inline double norm_of(exact::Point p) {
  return std::sqrt(dot(p, p));
}

inline Subject cylinder(float radius, float half_length, int axis) {
  Subject out = ball_on_segment(ContactKind::kCylinder, radius, half_length, axis);
  return out;
}

// The least of dot(d, p) over a placed body, in double.
inline double least(const Subject& s, exact::Point d) {
  const exact::ConvexCore core = s.placed();
  if (s.shape.kind != ContactKind::kCylinder) {
    double lowest = 1e300;
    for (const exact::Point p : core.vertices) lowest = std::min(lowest, dot(p, d));
    return lowest - core.radius_m * norm_of(d);
  }
  const exact::Point along = core.directions[0];
  const exact::Point center = 0.5 * (core.vertices[0] + core.vertices[1]);
  const double on_axis = dot(d, along);
  return dot(d, center) - std::abs(on_axis) * s.shape.half_length_m - s.shape.radius_m * norm_of(d - on_axis * along);
}

inline double gap_along(const Subject& a, const Subject& b, exact::Point d) {
  return least(a, d) + least(b, -1.0 * d);
}

inline double off(const Subject& s, exact::Point p) {
  if (s.shape.kind != ContactKind::kCylinder) return off_surface(s, p);
  const exact::ConvexCore core = s.placed();
  const exact::Point local = p - 0.5 * (core.vertices[0] + core.vertices[1]);
  const double on_axis = dot(local, core.directions[0]);
  const double over_end = std::abs(on_axis) - s.shape.half_length_m;
  const double over_side = norm_of(local - on_axis * core.directions[0]) - s.shape.radius_m;
  if (over_end > 0.0 && over_side > 0.0) return std::hypot(over_end, over_side);
  return std::abs(std::max(over_end, over_side));
}

// The widest gap that a search over directions finds: 1500 spread over the sphere, then steps that shrink about the
// best.
inline double widest_gap(const Subject& a, const Subject& b) {
  double best = -1e300;
  exact::Point at;
  const auto attempt = [&](exact::Point d) {
    const double gap = gap_along(a, b, d);
    if (gap > best) {
      best = gap;
      at = d;
    }
  };
  constexpr int kDirections = 1500;
  for (int k = 0; k < kDirections; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / kDirections;
    const double turn = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    attempt({r * std::cos(turn), r * std::sin(turn), z});
  }
  for (double step = 0.1; step > 1e-7; step *= 0.7)
    for (int k = 0; k < 16; ++k) {
      const double turn = k * std::numbers::pi / 8.0;
      const exact::Point u = std::abs(at.x) < 0.7 ? cross(at, {1, 0, 0}) : cross(at, {0, 1, 0});
      const exact::Point w = cross(at, u);
      const exact::Point d = at + (step * std::cos(turn)) * u + (step * std::sin(turn)) * w;
      attempt((1.0 / norm_of(d)) * d);
    }
  return best;
}

inline Subject other_body(Draw& draw, int kind) {
  if (kind == 0) return sphere(draw.between(0.2F, 1.0F));
  if (kind == 1) return capsule(draw.between(0.1F, 0.5F), draw.between(0.1F, 1.0F), draw.below(3));
  if (kind == 2) return box({draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F)});
  return cylinder(draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F), draw.below(3));
}

}  // namespace broadside::core

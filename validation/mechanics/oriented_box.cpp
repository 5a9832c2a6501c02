#include "validation/mechanics/oriented_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace broadside::validation {
namespace {

Vec3d axis_of(const Mat3d& r, int k) {
  return {r.row[0][k], r.row[1][k], r.row[2][k]};
}

}  // namespace

OrientedBox oriented_box(const BodyFacts& facts, Vec3d origin, const Mat3d& r) {
  return {origin + r * facts.box_center, r, facts.box_half, facts.ball_radius_m};
}

double reach_along(const OrientedBox& box, Vec3d direction) {
  if (box.radius > 0.0) return box.radius;
  const Vec3d local = transposed_times(box.r, direction);
  return std::abs(local.x) * box.half.x + std::abs(local.y) * box.half.y + std::abs(local.z) * box.half.z;
}

double overlap_bound(const OrientedBox& a, const OrientedBox& b) {
  const Vec3d d = a.center - b.center;
  const auto along = [&](Vec3d n) { return reach_along(a, n) + reach_along(b, n) - std::abs(dot(d, n)); };
  double least = std::numeric_limits<double>::infinity();
  for (const OrientedBox* box : {&a, &b})
    if (!(box->radius > 0.0))
      for (int k = 0; k < 3; ++k) least = std::min(least, along(axis_of(box->r, k)));
  const double distance = length(d);
  if (distance > 0.0) least = std::min(least, along((1.0 / distance) * d));
  return std::isfinite(least) ? least : reach_along(a, {1.0, 0.0, 0.0}) + reach_along(b, {1.0, 0.0, 0.0});
}

double distance_outside(const OrientedBox& box, Vec3d point) {
  const Vec3d away = point - box.center;
  if (box.radius > 0.0) return std::max(0.0, length(away) - box.radius);
  const Vec3d local = transposed_times(box.r, away);
  const auto beyond = [](double at, double half) { return std::max(0.0, std::abs(at) - half); };
  return length({beyond(local.x, box.half.x), beyond(local.y, box.half.y), beyond(local.z, box.half.z)});
}

}  // namespace broadside::validation

#include "core/exact/rigid_motion.hpp"

#include <cmath>

namespace broadside::exact {
namespace {

constexpr double kRoundings = 64.0;
constexpr double kUnitRoundoff = 0x1p-53;

}  // namespace

Placement placement_at(const RigidMotion& motion, double t) {
  Placement out = to_placement(motion.start);
  out.origin = out.origin + t * motion.displacement_m;
  const double angle = length(motion.rotation_rad);
  if (!(angle > 0.0)) return out;
  // The rotation by t angle about the axis, applied after the orientation at the start.
  const double half = 0.5 * t * angle;
  const double w = std::cos(half);
  const Point v = (std::sin(half) / angle) * motion.rotation_rad;
  const auto [qw, qx, qy, qz] = out.orientation;
  const Point q{qx, qy, qz};
  const Point turned = w * q + qw * v + cross(v, q);
  out.orientation = {w * qw - dot(v, q), turned.x, turned.y, turned.z};
  return out;
}

double placing_error_m(const RigidMotion& motion, double reach_m) {
  const double far = length(to_point(motion.start.position)) + length(motion.displacement_m);
  return kRoundings * kUnitRoundoff * (far + (1.0 + length(motion.rotation_rad)) * reach_m);
}

}  // namespace broadside::exact

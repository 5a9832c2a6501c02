#include "core/exact/swept_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace broadside::exact {
namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void grow(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

// One coordinate of a point of a moving and turning body: x(t) = rest + speed t + c cos(angle t) + s sin(angle t).
struct Coordinate {
  double rest, speed, c, s, angle;

  [[nodiscard]] double at(double t) const {
    return rest + speed * t + c * std::cos(angle * t) + s * std::sin(angle * t);
  }
};

// The extremes lie at the ends and where speed + angle (s cos - c sin) = 0. An error of rounding in such a time changes
// x by its square. Where two zeros nearly coincide and rounding hides them, x changes by its cube. Both are far below
// the rounding of x itself.
void grow(Range& range, const Coordinate& x) {
  range.grow(x.at(0.0));
  range.grow(x.at(1.0));
  const double amplitude = std::hypot(x.c, x.s);
  if (!(x.angle * amplitude > 0.0)) return;
  const double ratio = -x.speed / (x.angle * amplitude);
  if (!(std::abs(ratio) <= 1.0)) return;
  const double phase = std::atan2(x.c, x.s);  // s cos a - c sin a = amplitude cos(a + phase)
  const double turn = 2.0 * std::numbers::pi;
  for (const double root : {std::acos(ratio) - phase, -std::acos(ratio) - phase}) {
    double a = root - turn * std::floor(root / turn);
    while (a < x.angle) {
      range.grow(x.at(a / x.angle));
      a += turn;
    }
  }
}

float below(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) <= x ? f : std::nextafter(f, -std::numeric_limits<float>::infinity());
}

float above(double x) {
  return -below(-x);
}

}  // namespace

core::Box swept_box(std::span<const core::Vec3> vertices, const RigidMotion& motion) {
  const Placement start = placement_at(motion, 0.0);
  const double angle = length(motion.rotation_rad);
  const Point axis = angle > 0.0 ? (1.0 / angle) * motion.rotation_rad : Point{};
  const double origin[] = {start.origin.x, start.origin.y, start.origin.z};
  const double speed[] = {motion.displacement_m.x, motion.displacement_m.y, motion.displacement_m.z};
  Range range[3];
  double reach_m = 0.0;
  for (const core::Vec3 v : vertices) {
    const Point arm = start.turned({v.x, v.y, v.z});
    const Point along = dot(arm, axis) * axis;
    const Point out = arm - along;
    const Point side = cross(axis, arm);
    const double still[] = {along.x, along.y, along.z};
    const double c[] = {out.x, out.y, out.z};
    const double s[] = {side.x, side.y, side.z};
    for (int k = 0; k < 3; ++k) grow(range[k], {origin[k] + still[k], speed[k], c[k], s[k], angle});
    reach_m = std::max(reach_m, length(arm));
  }
  if (vertices.empty()) return core::empty_box();
  const double doubt_m = placing_error_m(motion, reach_m);
  core::Box box;
  for (int k = 0; k < 3; ++k) {
    box.min[k] = below(range[k].low - doubt_m);
    box.max[k] = above(range[k].high + doubt_m);
  }
  return box;
}

}  // namespace broadside::exact

#include "core/exact/rigid_touch.hpp"

#include <algorithm>

#include "core/exact/moving_pair.hpp"

namespace broadside::exact {
namespace {

// Relative to the sizes of both bodies.
constexpr double kTolerance = 1e-9;
// A step shorter than this share of the whole ends the search for the first touch.
constexpr double kLeastStep = 0x1p-46;
// Bodies that slide along each other at a tiny distance take tiny steps. After this many measurements the rest of the
// step is left undecided.
constexpr std::uint32_t kMostMeasurements = 4000;

// The earliest time that halving finds at which they certainly overlap. Precondition: no certain overlap at `before`, a
// certain one at `surely`.
double first_overlap(MovingPair& pair, double before, double surely, std::uint32_t& measurements) {
  while (surely - before > kLeastStep) {
    const double middle = 0.5 * (before + surely);
    if (middle <= before || middle >= surely) break;
    ++measurements;
    (pair.overlap_at(middle) ? surely : before) = middle;
  }
  return surely;
}

// Continues from `time`, at which they almost touch, by steps that double: until they overlap or are apart again.
struct Ahead {
  bool overlap = false;
  double time = 0.0;
};

Ahead look_ahead(MovingPair& pair, double time, double tolerance_m, std::uint32_t& measurements) {
  double before = time;
  if (pair.overlap_at(time)) return {true, time};
  for (double step = kLeastStep; before < 1.0; step *= 2.0) {
    const double now = std::min(1.0, time + step);
    measurements += 2;
    if (pair.overlap_at(now)) return {true, first_overlap(pair, before, now, measurements)};
    const Parting parting = pair.parting_at(now);
    if (parting.gap_m > 2.0 * tolerance_m && parting.until > now + kLeastStep) return {false, now};
    before = now;
  }
  return {false, 1.0};
}

}  // namespace

MovingShape::MovingShape(const core::Mesh& mesh, bool as_solid) {
  auto parts = std::make_shared<Parts>();
  if (as_solid) parts->solid = convex_core_of(mesh);
  parts->surface = make_sphere_tree(mesh);
  for (const core::Vec3 v : mesh.vertices) parts->reach_m = std::max(parts->reach_m, length(to_point(v)));
  if (parts->solid)
    for (const Point p : parts->solid->vertices)
      parts->reach_m = std::max(parts->reach_m, length(p) + parts->solid->radius_m);
  parts_ = std::move(parts);
}

bool MovingShape::is_solid() const {
  return parts_->solid.has_value();
}

double MovingShape::reach_m() const {
  return parts_->reach_m;
}

double touch_tolerance_m(const MovingShape& a, const MovingShape& b) {
  return kTolerance * (a.reach_m() + b.reach_m());
}

RigidTouch first_touch(const MovingShape& a, const RigidMotion& motion_a, const MovingShape& b,
                       const RigidMotion& motion_b) {
  const bool are_solid = a.is_solid() && b.is_solid();
  const auto pair = are_solid ? solid_pair(a, motion_a, b, motion_b) : surface_pair(a, motion_a, b, motion_b);
  const double tolerance = touch_tolerance_m(a, b);
  RigidTouch out;
  double time = 0.0;
  while (out.measurements < kMostMeasurements) {
    ++out.measurements;
    const Parting parting = pair->parting_at(time);
    if (parting.until > 1.0) return out;
    if (parting.gap_m > tolerance && parting.until > time + kLeastStep) {
      time = parting.until;
      continue;
    }
    if (out.meeting == Meeting::kApart) out.lower = time;
    out.meeting = Meeting::kGraze;
    const Ahead ahead = look_ahead(*pair, time, tolerance, out.measurements);
    if (ahead.overlap) {
      out.meeting = Meeting::kTouch;
      out.upper = ahead.time;
      return out;
    }
    if (ahead.time >= 1.0) return out;
    time = ahead.time;
  }
  if (out.meeting == Meeting::kApart) out.lower = time;
  out.meeting = Meeting::kGraze;
  return out;
}

}  // namespace broadside::exact

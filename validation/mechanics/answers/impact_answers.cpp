// One impact: a rod, billiards, a needle.
#include <algorithm>
#include <array>

#include "validation/mechanics/answers/answer_parts.hpp"

namespace broadside::validation {
namespace {

// Whether a time is within two steps of the impact: there no figure is taken.
bool is_near(double t, double event_s, const Motion& m) {
  return std::abs(t - event_s) <= 2.0 * m.h;
}

// A corner of the box, in the world, relative to the center.
Vec3d lowest_corner(const BodyFacts& f, const Mat3d& r) {
  Vec3d sum;
  for (int k = 0; k < 3; ++k) {
    const double half = k == 0 ? f.box_half.x : (k == 1 ? f.box_half.y : f.box_half.z);
    const Vec3d axis{r.row[0][k], r.row[1][k], r.row[2][k]};
    // The corners of a level edge share the impulse, so the edge's middle stands for them.
    if (std::abs(axis.y) > 1e-6) sum = sum + (axis.y > 0.0 ? -half : half) * axis;
  }
  return sum;
}

// Smooth: J = (1 + e) v / (1 / m + x^2 / I), x the lever of the end that meets the floor; (1 + e) m v / (1 + 3 cos^2
// phi) for a thin rod.
Figures rod_impact(const core::Scene& scene, const Motion& m, double) {
  const BodyFacts& f = m.facts[0];
  const Vec3d end = lowest_corner(f, matrix_of(normalized(to_quatd(scene.bodies[0].orientation))));
  const double speed = -start_velocity(scene).y;
  const double meets = (start_position(scene).y + end.y - scene.domain.min.y) / speed;
  const double t = time_of(m);
  if (is_near(t, meets, m)) return {};
  const BodyState& s = m.bodies[0].after;
  double v = -speed;
  double w = 0.0;
  if (t > meets) {
    const double inertia = f.inertia.row[2].z;
    const double j = (1.0 + plane_of(scene, m).restitution) * speed / (1.0 / f.mass_kg + end.x * end.x / inertia);
    v += j / f.mass_kg;
    w = end.x * j / inertia;
  }
  return {classed("velocity", "m/s", length(s.v - Vec3d{0.0, v, 0.0}), speed),
          classed("angular velocity", "rad/s", length(s.w - Vec3d{0.0, 0.0, w}), speed / length(end))};
}

// Two balls of one mass, e = 1: the second takes the component along the line of centers.
Figures billiards(const core::Scene& scene, const Motion& m, double) {
  const Vec3d v0 = start_velocity(scene);
  const double speed = length(v0);
  const Vec3d along = unit(v0);
  const Vec3d between = Vec3d(scene.bodies[1].position) - start_position(scene);
  const double reach = m.facts[0].box_half.x + m.facts[1].box_half.x;
  const double ahead = dot(between, along);
  const double offset = length(between - ahead * along);
  if (!(offset < reach)) return {};
  const double meets = (ahead - std::sqrt(reach * reach - offset * offset)) / speed;
  const double t = time_of(m);
  if (is_near(t, meets, m)) return {};
  const Vec3d line = (1.0 / reach) * (between - (meets * speed) * along);  // unit, from the first to the second
  const Vec3d given = t < meets ? Vec3d{} : dot(v0, line) * line;
  // A contact may be found up to a step early, which turns the line of centers by the way across in a step; head on it
  // does not turn.
  const double limit =
      speed * std::min(1.0, speed * m.h / reach) * std::min(1.0, 4.0 * offset / reach) + kClassA * speed;
  ExactFigure first = touching("velocity of the first", "m/s", length(m.bodies[0].after.v - (v0 - given)), limit, 0.0);
  ExactFigure second = touching("velocity of the second", "m/s", length(m.bodies[1].after.v - given), limit, 0.0);
  // The part of the step that is left after the touch varies with h without an order.
  first.has_order = second.has_order = false;
  return {first, second};
}

// One ball onto two that touch, in the middle: momentum, energy and symmetry leave one answer.
Figures three_balls(const core::Scene& scene, const Motion& m, double) {
  const Vec3d v0 = start_velocity(scene);
  const double speed = length(v0);
  const double reach = m.facts[0].box_half.x + m.facts[1].box_half.x;
  const Vec3d to_pair =
      0.5 * (Vec3d(scene.bodies[1].position) + Vec3d(scene.bodies[2].position)) - start_position(scene);
  const double meets = (dot(to_pair, unit(v0)) - std::sqrt(0.75) * reach) / speed;
  const double t = time_of(m);
  if (t < meets + 2.0 * m.h) return {};
  const Vec3d beside = unit(Vec3d(scene.bodies[1].position) - Vec3d(scene.bodies[2].position));
  const Vec3d second = (0.4 * std::sqrt(3.0) * speed) * (std::sqrt(0.75) * unit(v0) + 0.5 * beside);
  return {classed("velocity of the first", "m/s", length(m.bodies[0].after.v + 0.2 * v0), speed),
          classed("velocity of the second", "m/s", length(m.bodies[1].after.v - second), speed)};
}

// A needle that turns about its middle under a plate: its corner meets the plate at (asin(d / r) - phi) / w, and the
// impulse stops the approach.
Figures first_touch(const core::Scene& scene, const Motion& m, double) {
  const BodyFacts& f = m.facts[0];
  const Vec3d under = Vec3d(scene.bodies[1].position) - start_position(scene);
  const double d = under.y - m.facts[1].box_half.y;
  const double r = std::hypot(f.box_half.x, f.box_half.y);
  const double spin = Vec3d(scene.bodies[0].angular_velocity).z;
  const double touch = (std::asin(d / r) - std::atan2(f.box_half.y, f.box_half.x)) / spin;
  const double t = time_of(m);
  const BodyState& s = m.bodies[0].after;
  if (t + m.h < touch)
    return {
        smooth("angular velocity before the touch", "rad/s", std::abs(s.w.z - spin), 0.0, rounding_over(m, 16, spin))};
  if (t < touch + m.h) return {};
  const double lever = std::sqrt(r * r - d * d);
  const double inertia = f.inertia.row[2].z;
  const double j = spin * lever / (1.0 / f.mass_kg + lever * lever / inertia);
  const double after = spin - j * lever / inertia;
  // Where the needle is stopped up to a step early, the lever differs.
  ExactFigure figure = touching("angular velocity after the touch", "rad/s", std::abs(s.w.z - after),
                                std::abs(spin) * std::min(0.5, std::abs(spin) * m.h), 0.0);
  figure.has_order = false;
  return {figure};
}

}  // namespace

std::span<const SceneAnswer> impact_answers() {
  static const std::array<SceneAnswer, 4> kTable{{
      {"rod-impact", "J = (1 + e) m v / (1 + 3 cos^2 phi)", "Newton's restitution, a rod's inertia", rod_impact},
      {"billiards", "the second takes the component along the line of centers", "Huygens, De motu corporum (1703)",
       billiards},
      {"three-balls", "the first keeps -1/5 of its velocity", "momentum, energy and symmetry", three_balls},
      {"first-touch", "the tip meets the plate at (asin(d / r) - phi) / w and stops there",
       "geometry; an impact with e = 0", first_touch},
  }};
  return kTable;
}

}  // namespace broadside::validation

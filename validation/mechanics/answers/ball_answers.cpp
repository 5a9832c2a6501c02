// Balls that roll and bounce.
#include <algorithm>
#include <array>

#include "validation/mechanics/answers/answer_parts.hpp"

namespace broadside::validation {
namespace {

// A ball that starts to slip rolls from t = 2 v0 / (7 mu g) on, at 5/7 v0.
Figures slip_to_roll(const core::Scene& scene, const Motion& m, double) {
  const Plane plane = plane_of(scene, m);
  const double brake = plane.friction * -dot(m.gravity, plane.normal);
  const Vec3d v0 = start_velocity(scene);
  const double speed = length(v0);
  const double rolls = 2.0 * speed / (7.0 * brake);
  const double t = time_of(m);
  const double slipping = std::min(t, rolls);
  const double x = speed * slipping - 0.5 * brake * slipping * slipping + (5.0 / 7.0) * speed * (t - slipping);
  const double v = t < rolls ? speed - brake * t : (5.0 / 7.0) * speed;
  const Vec3d along = unit(v0);
  const double off = rounding_over(m, 16, length(start_position(scene)) + x + speed);
  return {touching("distance", "m", std::abs(dot(m.bodies[0].after.x - start_position(scene), along) - x),
                   one_step_late(brake, m), off),
          touching("speed", "m/s", std::abs(dot(m.bodies[0].after.v, along) - v), 2.0 * brake * m.h, off)};
}

// From rest on a plane: rolls with 5/7 g sin where mu >= 2/7 tan, else slips with g (sin - mu cos).
Figures roll_incline(const core::Scene& scene, const Motion& m, double) {
  const Plane plane = plane_of(scene, m);
  const Vec3d pull = across(m.gravity, plane.normal);
  const double onto = -dot(m.gravity, plane.normal);
  const double a = std::max((5.0 / 7.0) * length(pull), length(pull) - plane.friction * onto);
  const double t = time_of(m);
  const double x = 0.5 * a * t * t;
  const double moved = dot(m.bodies[0].after.x - start_position(scene), unit(pull));
  return {touching("distance", "m", std::abs(moved - x), one_step_late(length(pull), m),
                   2.0 * scene.parameters.delta_m + rounding_over(m, 16, x + length(start_position(scene))))};
}

// One bounce off the plane without gravity: J_t = min(mu (1 + e) m v_n, 2/7 m v_t).
Figures oblique_bounce(const core::Scene& scene, const Motion& m, double) {
  const Plane plane = plane_of(scene, m);
  const BodyFacts& f = m.facts[0];
  const double radius = f.box_half.y;
  const Vec3d v0 = start_velocity(scene);
  const double onto = -dot(v0, plane.normal);
  const Vec3d sliding = across(v0, plane.normal);
  const double gap = start_position(scene).y - scene.domain.min.y - radius;
  if (time_of(m) < gap / onto + 2.0 * m.h) return {};
  const double spin = f.inertia.row[0].x / (f.mass_kg * radius * radius);  // 2/5
  const double stick = length(sliding) * spin / (1.0 + spin);              // 2/7 v_t
  const double braked = std::min(plane.friction * (1.0 + plane.restitution) * onto, stick);
  const Vec3d v = (plane.restitution * onto) * plane.normal + (length(sliding) - braked) * unit(sliding);
  const Vec3d w = (braked / (spin * radius)) * cross(plane.normal, unit(sliding));
  return {classed("velocity", "m/s", length(m.bodies[0].after.v - v), length(v0)),
          classed("angular velocity", "rad/s", length(m.bodies[0].after.w - w), length(v0) / radius)};
}

// Apexes e^(2k) h0: the height above the floor at a time.
Figures bounce(const core::Scene& scene, const Motion& m, double) {
  const double g = -m.gravity.y;
  const double e = plane_of(scene, m).restitution;
  const double radius = m.facts[0].box_half.y;
  const double h0 = start_position(scene).y - radius - scene.domain.min.y;
  double left = time_of(m);
  double fall = std::sqrt(2.0 * h0 / g);
  double top = h0;
  double up = 0.0;  // time from the floor to the apex of the present arc
  double lag = 2.0 * m.h * std::sqrt(2.0 * g * h0);
  while (left >= up + fall) {
    left -= up + fall;
    top *= e * e;
    fall = up = std::sqrt(2.0 * top / g);
    // Each bounce comes up to one step early or late, and the apex after it is off by the body's speed times that.
    lag += 2.0 * m.h * std::sqrt(2.0 * g * h0);
    // Arcs shorter than four steps are rest to a time stepper.
    if (up < 2.0 * m.h) return {};
  }
  const double height = top - 0.5 * g * (left - up) * (left - up);
  const double actual = m.bodies[0].after.x.y - radius - scene.domain.min.y;
  ExactFigure f = touching("height", "m", std::abs(actual - height), lag + one_step_late(0.5 * g, m), 0.0);
  // The error depends on when in a step each bounce falls, and so has no order.
  f.has_order = false;
  return {f};
}

}  // namespace

std::span<const SceneAnswer> ball_answers() {
  static const std::array<SceneAnswer, 4> kTable{{
      {"slip-to-roll", "rolls at 5/7 v0 from 2 v0 / (7 mu g) on", "Coriolis, Theorie du jeu de billard (1835)",
       slip_to_roll},
      {"roll-incline", "a = 5/7 g sin, or g (sin - mu cos) where it slips", "a ball's inertia 2/5 m r^2", roll_incline},
      {"oblique-bounce", "J_t = min(mu (1 + e) m v_n, 2/7 m v_t)", "Newton's restitution, Coulomb's friction",
       oblique_bounce},
      {"bounce", "apexes e^(2k) h0", "Newton's restitution", bounce},
  }};
  return kTable;
}

}  // namespace broadside::validation

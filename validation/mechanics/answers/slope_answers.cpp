// Boxes that slide, and a ladder that falls.
#include <algorithm>
#include <array>

#include "validation/mechanics/answers/answer_parts.hpp"

namespace broadside::validation {
namespace {

// How far bodies may settle: the slop, on the way in and on the way out.
double settling(const core::Scene& scene) {
  return 2.0 * scene.parameters.delta_m;
}

// Down a plane: a = |pull along| - mu |pull across|, from rest.
Figures incline(const core::Scene& scene, const Motion& m, double) {
  const Plane plane = plane_of(scene, m);
  const Vec3d pull = m.gravity + (1.0 / m.facts[0].mass_kg) * m.facts[0].force_world_n;
  const double onto = -dot(pull, plane.normal);
  const Vec3d along = across(pull, plane.normal);
  const double a = std::max(0.0, length(along) - plane.friction * onto);
  const double t = time_of(m);
  const double slid = dot(m.bodies[0].after.x - start_position(scene), unit(along));
  // Friction that has not begun, or has begun too early.
  return {touching("distance down the plane", "m", std::abs(slid - 0.5 * a * t * t),
                   one_step_late(length(along) + plane.friction * onto, m),
                   settling(scene) + rounding_over(m, 8, length(start_position(scene)) + slid))};
}

// v0^2 / (2 mu g), whatever the heading.
Figures slide(const core::Scene& scene, const Motion& m, double) {
  const Plane plane = plane_of(scene, m);
  const double brake = plane.friction * -dot(m.gravity, plane.normal);
  const Vec3d v0 = start_velocity(scene);
  const double stop = length(v0) / brake;
  const double t = std::min(time_of(m), stop);
  const Vec3d way = (t - 0.5 * t * t / stop) * v0;
  const Vec3d moved = m.bodies[0].after.x - start_position(scene);
  return {touching("place on the plane", "m", length(across(moved - way, plane.normal)), one_step_late(2.0 * brake, m),
                   settling(scene) + rounding_over(m, 8, length(v0) * t + length(start_position(scene))))};
}

// The ladder as one angle. Corners of its underside slide along the wall and the floor: from the wall, the center is
// (L cos + w sin) / 2 away, and as high as (L sin + w cos) / 2.
struct Ladder {
  double length = 0.0;
  double thick = 0.0;
  double mass = 0.0;
  double inertia = 0.0;
  double g = 0.0;

  [[nodiscard]] double x_rate(double a) const { return 0.5 * (-length * std::sin(a) + thick * std::cos(a)); }
  [[nodiscard]] double y_rate(double a) const { return 0.5 * (length * std::cos(a) - thick * std::sin(a)); }
  [[nodiscard]] double x_curve(double a) const { return 0.5 * (-length * std::cos(a) - thick * std::sin(a)); }
  [[nodiscard]] double y_curve(double a) const { return 0.5 * (-length * std::sin(a) - thick * std::cos(a)); }
  // Lagrange's equation: M a'' + M' a'^2 / 2 = -m g y'.
  [[nodiscard]] double acceleration(double a, double w) const {
    const double moving = mass * (x_rate(a) * x_rate(a) + y_rate(a) * y_rate(a)) + inertia;
    const double slope = mass * (x_rate(a) * x_curve(a) + y_rate(a) * y_curve(a));
    return (-mass * g * y_rate(a) - slope * w * w) / moving;
  }
  // Of the center, away from the wall: below zero the wall would have to pull.
  [[nodiscard]] double push(double a, double w) const { return x_rate(a) * acceleration(a, w) + x_curve(a) * w * w; }
};

struct Fall {
  double angle = 0.0;
  double rate = 0.0;
  bool has_left = false;
};

// From rest to time t, or to where it leaves the wall, by the classical Runge-Kutta method.
Fall fall(const Ladder& ladder, double angle, double t) {
  constexpr double kStep_s = 1e-4;
  Fall s{angle, 0.0, false};
  const int steps = std::max(1, static_cast<int>(std::ceil(t / kStep_s)));
  const double h = t / steps;
  for (int k = 0; k < steps && !s.has_left; ++k) {
    const double a1 = ladder.acceleration(s.angle, s.rate);
    const double a2 = ladder.acceleration(s.angle + 0.5 * h * s.rate, s.rate + 0.5 * h * a1);
    const double a3 = ladder.acceleration(s.angle + 0.5 * h * s.rate + 0.25 * h * h * a1, s.rate + 0.5 * h * a2);
    const double a4 = ladder.acceleration(s.angle + h * s.rate + 0.5 * h * h * a2, s.rate + h * a3);
    s.angle += h * s.rate + h * h / 6.0 * (a1 + a2 + a3);
    s.rate += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    s.has_left = ladder.push(s.angle, s.rate) < 0.0;
  }
  return s;
}

// While it leans, its angle; then nothing pushes it sideways, and it keeps the speed that it left the wall with. A thin
// ladder leaves at sin = 2/3 of the sine that it started with.
Figures ladder(const core::Scene& scene, const Motion& m, double) {
  if (m.step % static_cast<std::uint64_t>(std::max(1.0, std::round(0.05 / m.h))) != 0) return {};
  const BodyFacts& f = m.facts[0];
  const Ladder body{2.0 * f.box_half.x, 2.0 * f.box_half.y, f.mass_kg, f.inertia.row[2].z, length(m.gravity)};
  const auto lean = [](const Mat3d& r) { return std::atan2(-r.row[1].x, r.row[0].x); };
  const double start = lean(matrix_of(normalized(to_quatd(scene.bodies[0].orientation))));
  const double t = time_of(m);
  const Fall exact = fall(body, start, t);
  const BodyState& s = m.bodies[0].after;
  // From rest the angle runs away with this rate at most; an error of one step's start grows with it.
  const double growth = std::exp(t * std::sqrt(1.5 * body.g / body.length));
  if (!exact.has_left)
    return {touching("angle", "rad", std::abs(lean(s.r) - exact.angle),
                     growth * one_step_late(1.5 * body.g / body.length, m), growth * settling(scene) / body.length)};
  const double speed = body.x_rate(exact.angle) * exact.rate;
  // The floor is smooth, so the phase after the wall lasts until the ladder lies.
  const double height = s.x.y - scene.domain.min.y;
  if (height < f.box_half.y + 2.0 * m.h * length(s.v)) return {};
  return {touching("speed away from the wall", "m/s", std::abs(s.v.x - speed), growth * body.g * m.h,
                   growth * settling(scene) * body.g / speed)};
}

}  // namespace

std::span<const SceneAnswer> slope_answers() {
  static const std::array<SceneAnswer, 3> kTable{{
      {"incline", "a = g (sin - mu cos), or rest", "Coulomb", incline},
      {"slide", "stops after v0^2 / (2 mu g)", "Coulomb", slide},
      {"ladder", "a smooth ladder leaves the wall at sin = 2/3 sin of its start", "Lagrange's equation of its angle",
       ladder},
  }};
  return kTable;
}

}  // namespace broadside::validation

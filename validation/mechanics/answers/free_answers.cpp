// Bodies that touch nothing.
#include <algorithm>
#include <array>

#include "validation/mechanics/answers/answer_parts.hpp"
#include "validation/mechanics/answers/free_turning.hpp"

namespace broadside::validation {
namespace {

Vec3d moments_of(const BodyFacts& f) {
  return {f.inertia.row[0].x, f.inertia.row[1].y, f.inertia.row[2].z};
}

// x = x0 + v0 t + a t^2 / 2. Methods of order 2 and more are exact on it: the third derivative is zero.
Figures flight(const core::Scene& scene, const Motion& m, double order) {
  const double t = time_of(m);
  const Vec3d a = m.gravity + (1.0 / m.facts[0].mass_kg) * m.facts[0].force_world_n;
  const Vec3d x = start_position(scene) + t * start_velocity(scene) + (0.5 * t * t) * a;
  const Vec3d v = start_velocity(scene) + t * a;
  const double speed = length(v) + length(a) * t;
  return {smooth("position", "m", length(m.bodies[0].after.x - x),
                 order < 2.0 ? truncation(length(a), m.h, order, t) : 0.0, rounding_over(m, 4, length(x) + t * speed)),
          smooth("velocity", "m/s", length(m.bodies[0].after.v - v), 0.0, rounding_over(m, 4, speed))};
}

// A torque T about a principal axis, constant in body axes: w = w0 + T t / I; the angle is its integral.
Figures spin_up(const core::Scene& scene, const Motion& m, double order) {
  const double t = time_of(m);
  const BodyFacts& f = m.facts[0];
  const Vec3d axis = unit(f.torque_body_n_m);
  const double alpha = length(f.torque_body_n_m) / dot(axis, f.inertia * axis);
  const double w0 = dot(axis, Vec3d(scene.bodies[0].angular_velocity));
  const double w = w0 + alpha * t;
  const double angle = w0 * t + 0.5 * alpha * t * t;
  const Quatd exact = to_quatd(scene.bodies[0].orientation) * turn_by(angle * axis);
  const BodyState& s = m.bodies[0].after;
  const double cut = truncation(order < 2.0 ? alpha : w * w * w, m.h, order, t);
  return {
      smooth("attitude", "rad", angle_of(conjugate(normalized(exact)) * s.q), cut, rounding_over(m, 16, 1.0 + angle)),
      smooth("angular velocity", "rad/s", length(transposed_times(s.r, s.w) - w * axis), 0.0, rounding_over(m, 16, w))};
}

// Between two attitudes, from the Frobenius norm of their difference: 2 sqrt(2) sin(angle / 2).
double angle_between(const Mat3d& a, const Mat3d& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d d = a.row[k] - b.row[k];
    sum += dot(d, d);
  }
  return 2.0 * std::asin(std::min(1.0, std::sqrt(sum / 8.0)));
}

// Error of the exact answer itself, rad: that of the precession's integral.
constexpr double kQuadrature = 1e-8;

// Attitudes are compared ten times a second: each takes an integral from the start.
bool is_due(const Motion& m) {
  return m.step % static_cast<std::uint64_t>(std::max(1.0, std::round(0.1 / m.h))) == 0;
}

// Derivatives of an attitude of order p + 1 are of the size of w^(p + 1).
ExactFigure attitude(const Motion& m, double error, double order, double spin, double growth) {
  const double floor = growth * rounding_over(m, 16, 1.0) + spin * time_of(m) * m.rounding_of(16) + kQuadrature;
  return smooth("attitude", "rad", error, growth * truncation(std::pow(spin, order + 1.0), m.h, order, time_of(m)),
                floor);
}

// Bodies whose mesh axes are their principal axes: boxes.
Figures torque_free(const core::Scene& scene, const Motion& m, double order) {
  if (!is_due(m)) return {};
  const core::Body& b = scene.bodies[0];
  const Quatd q0 = normalized(to_quatd(b.orientation));
  const double t = time_of(m);
  const Vec3d w0(b.angular_velocity);
  const FreeTurning exact(moments_of(m.facts[0]), transposed_times(matrix_of(q0), w0), q0);
  const BodyState& s = m.bodies[0].after;
  const double spin = length(w0);
  const ExactFigure angle = attitude(m, angle_between(exact.attitude(t), s.r), order, spin, exact.growth());
  return {angle, smooth("angular velocity in body axes", "rad/s",
                        length(transposed_times(s.r, s.w) - exact.angular_velocity(t)),
                        spin * (angle.limit - angle.floor), spin * angle.floor)};
}

// Two equal moments I1: the axis of the third goes round L at L / I1, and the body turns about it at (1 - I3 / I1) w3.
Figures top(const core::Scene& scene, const Motion& m, double order) {
  if (!is_due(m)) return {};
  const core::Body& b = scene.bodies[0];
  const Vec3d moments = moments_of(m.facts[0]);
  const double spread[3] = {std::abs(moments.y - moments.z), std::abs(moments.z - moments.x),
                            std::abs(moments.x - moments.y)};
  const auto k = static_cast<int>(std::min_element(spread, spread + 3) - spread);
  const Vec3d axis{k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
  const double own = moments[k];
  const double other = moments[(k + 1) % 3];
  const Quatd q0 = normalized(to_quatd(b.orientation));
  const Vec3d w = transposed_times(matrix_of(q0), Vec3d(b.angular_velocity));
  const Vec3d l{moments.x * w.x, moments.y * w.y, moments.z * w.z};
  const double t = time_of(m);
  const Quatd turned =
      turn_by((t / other) * (matrix_of(q0) * l)) * q0 * turn_by(((1.0 - own / other) * w[k] * t) * axis);
  return {attitude(m, angle_of(conjugate(turned) * m.bodies[0].after.q), order, std::max(length(w), length(l) / other),
                   1.0)};
}

constexpr std::string_view kLandau = "Landau and Lifshitz, Mechanics, sections 35 to 37";

}  // namespace

std::span<const SceneAnswer> free_answers() {
  static const std::array<SceneAnswer, 4> kTable{{
      {"flight", "x = x0 + v0 t + (g + F / m) t^2 / 2", "Galileo", flight},
      {"spin-up", "w = w0 + T t / I about a principal axis", "Euler", spin_up},
      {"torque-free", "Jacobi's functions, and Euler's angles about L", kLandau, torque_free},
      {"top", "the axis goes round L at L / I1", kLandau, top},
  }};
  return kTable;
}

}  // namespace broadside::validation

#include "validation/mechanics/scene_answer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace broadside::validation {
namespace {

using Figures = std::vector<ExactFigure>;

double time_of(const Motion& m) {
  return static_cast<double>(m.step) * m.h;
}

// Errors of an engine of order p over a time t: each step is off by a part of h^(p + 1), and steps add up.
double truncation(double derivative, double h, double order, double t) {
  return derivative * t * std::pow(h, order);
}

// The largest coefficient of friction that acts between body 0 and the floor.
double floor_friction(const core::Scene& scene) {
  return std::sqrt(double{scene.bodies[0].material.mu_kinetic} * scene.face_material.mu_kinetic);
}

Vec3d start_velocity(const core::Scene& scene) {
  return Vec3d(scene.bodies[0].velocity);
}

// x = x0 + v0 t + g t^2 / 2, until something is touched.
Figures flight(const core::Scene& scene, const Motion& m, double order) {
  const double t = time_of(m);
  const core::Body& b = scene.bodies[0];
  const Vec3d x = Vec3d(b.position) + t * Vec3d(b.velocity) + (0.5 * t * t) * m.gravity;
  const Vec3d v = Vec3d(b.velocity) + t * m.gravity;
  const double g = length(m.gravity);
  const double scale = length(x) + t * length(v);
  const double steps = static_cast<double>(m.step);
  return {{"position", "m", length(m.bodies[0].after.x - x),
           truncation(0.5 * g, m.h, order, t) + m.rounding_of(4 * steps) * scale},
          {"velocity", "m/s", length(m.bodies[0].after.v - v), m.rounding_of(4 * steps) * (length(v) + g * t)}};
}

// Euler's equations of a free body, integrated in body axes by the classical Runge-Kutta method with steps so small
// that their error is far below every limit; the attitude with them. The period that Jacobi's functions give is checked
// against this integration in the tests.
struct FreeBody {
  Vec3d w;  // body axes
  Quatd q;
};

FreeBody rate_of(const FreeBody& s, Vec3d moments) {
  const Vec3d dw{(moments.y - moments.z) * s.w.y * s.w.z / moments.x,
                 (moments.z - moments.x) * s.w.z * s.w.x / moments.y,
                 (moments.x - moments.y) * s.w.x * s.w.y / moments.z};
  const Quatd half = s.q * Quatd{0.0, 0.5 * s.w.x, 0.5 * s.w.y, 0.5 * s.w.z};
  return {dw, half};
}

FreeBody plus(const FreeBody& s, const FreeBody& d, double h) {
  return {s.w + h * d.w, {s.q.w + h * d.q.w, s.q.x + h * d.q.x, s.q.y + h * d.q.y, s.q.z + h * d.q.z}};
}

FreeBody spun(FreeBody s, Vec3d moments, double t) {
  constexpr double kStep = 1e-3;
  const int steps = std::max(1, static_cast<int>(std::ceil(t / kStep)));
  const double h = t / steps;
  for (int k = 0; k < steps; ++k) {
    const FreeBody a = rate_of(s, moments);
    const FreeBody b = rate_of(plus(s, a, 0.5 * h), moments);
    const FreeBody c = rate_of(plus(s, b, 0.5 * h), moments);
    const FreeBody d = rate_of(plus(s, c, h), moments);
    s = plus(plus(plus(plus(s, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
    s.q = normalized(s.q);
  }
  return s;
}

// Bodies whose mesh axes are their principal axes: boxes, spheres.
Figures torque_free(const core::Scene& scene, const Motion& m, double order) {
  // Integrating from the start each step would cost the square of the steps: ten times a second is enough.
  const auto every = static_cast<std::uint64_t>(std::max(1.0, std::round(0.1 / m.h)));
  if (m.step % every != 0) return {};
  const BodyFacts& f = m.facts[0];
  const core::Body& b = scene.bodies[0];
  const Vec3d moments{f.inertia.row[0].x, f.inertia.row[1].y, f.inertia.row[2].z};
  const Quatd q0 = normalized(to_quatd(b.orientation));
  const double t = time_of(m);
  const FreeBody exact = spun({transposed_times(matrix_of(q0), Vec3d(b.angular_velocity)), q0}, moments, t);
  const double spin = length(Vec3d(b.angular_velocity));
  const double error = angle_of(conjugate(exact.q) * m.bodies[0].after.q);
  // A step of order p is off by (h w)^(p + 1), and on an unstable axis errors grow with exp(lambda t), lambda <= w.
  const double growth = std::exp(std::min(3.0, spin * t));
  return {
      {"attitude", "rad", error,
       std::pow(m.h * spin, order) * spin * t * growth + m.rounding_of(8.0 * static_cast<double>(m.step)) * growth}};
}

// A box on a plane slides iff tan(theta) > mu, then with g (sin - mu cos); gravity is tilted instead of the plane.
Figures incline(const core::Scene& scene, const Motion& m, double order) {
  const double t = time_of(m);
  const double down = -m.gravity.y;
  const Vec3d along{m.gravity.x, 0.0, m.gravity.z};
  const double pull = length(along);
  const double mu = floor_friction(scene);
  const double a = std::max(0.0, pull - mu * down);
  const Vec3d start(scene.bodies[0].position);
  const Vec3d way = m.bodies[0].after.x - start;
  const double slid = dot(way, (1.0 / pull) * along);
  // Where friction begins is known to one step; what settles is the slop.
  const double g = length(m.gravity);
  return {{"distance down the plane", "m", std::abs(slid - 0.5 * a * t * t),
           truncation(g, m.h, order, t) + 2.0 * scene.parameters.delta_m +
               m.rounding_of(8.0 * static_cast<double>(m.step)) * (length(start) + slid)}};
}

// v0^2 / (2 mu g), whatever the heading.
Figures slide(const core::Scene& scene, const Motion& m, double order) {
  const double mu = floor_friction(scene);
  const double g = -m.gravity.y;
  const Vec3d v0 = start_velocity(scene);
  const double speed = length(v0);
  const double stop = speed / (mu * g);
  const double t = std::min(time_of(m), stop);
  const Vec3d way = (t - 0.5 * t * t / stop) * v0;
  const Vec3d moved = m.bodies[0].after.x - Vec3d(scene.bodies[0].position);
  const Vec3d across{moved.x - way.x, 0.0, moved.z - way.z};
  return {
      {"distance slid", "m", length(across),
       truncation(2.0 * mu * g, m.h, order, t) + 2.0 * scene.parameters.delta_m +
           m.rounding_of(8.0 * static_cast<double>(m.step)) * (speed * t + length(Vec3d(scene.bodies[0].position)))}};
}

// A ball that starts to slip rolls from t = 2 v0 / (7 mu g) on, at 5/7 v0.
Figures slip_to_roll(const core::Scene& scene, const Motion& m, double order) {
  const double mu = floor_friction(scene);
  const double g = -m.gravity.y;
  const Vec3d v0 = start_velocity(scene);
  const double speed = length(v0);
  const double rolls = 2.0 * speed / (7.0 * mu * g);
  const double t = time_of(m);
  const double slipping = std::min(t, rolls);
  const double x = speed * slipping - 0.5 * mu * g * slipping * slipping + (5.0 / 7.0) * speed * (t - slipping);
  const double v = t < rolls ? speed - mu * g * t : (5.0 / 7.0) * speed;
  const Vec3d along = (1.0 / speed) * v0;
  const Vec3d moved = m.bodies[0].after.x - Vec3d(scene.bodies[0].position);
  const double off = m.rounding_of(16.0 * static_cast<double>(m.step)) * (length(Vec3d(scene.bodies[0].position)) + x);
  return {{"distance", "m", std::abs(dot(moved, along) - x), truncation(2.0 * mu * g, m.h, order, t) + off},
          {"speed", "m/s", std::abs(dot(m.bodies[0].after.v, along) - v), 2.0 * mu * g * std::pow(m.h, order) + off}};
}

// A ball on a plane with mu >= 2/7 tan(theta) rolls with 5/7 g sin(theta).
Figures roll_incline(const core::Scene& scene, const Motion& m, double order) {
  const Vec3d along{m.gravity.x, 0.0, m.gravity.z};
  const double pull = length(along);
  const double t = time_of(m);
  const double a = std::max((5.0 / 7.0) * pull, pull - floor_friction(scene) * -m.gravity.y);
  const Vec3d moved = m.bodies[0].after.x - Vec3d(scene.bodies[0].position);
  const double x = 0.5 * a * t * t;
  return {{"distance", "m", std::abs(dot(moved, (1.0 / pull) * along) - x),
           truncation(length(m.gravity), m.h, order, t) +
               m.rounding_of(16.0 * static_cast<double>(m.step)) * (x + length(Vec3d(scene.bodies[0].position)))}};
}

// Apexes e^(2k) h0. The height above the floor of a ball, between bounces, from the energy that it has left.
Figures bounce(const core::Scene& scene, const Motion& m, double order) {
  const double g = -m.gravity.y;
  const double e = std::max(scene.bodies[0].material.restitution, scene.face_material.restitution);
  const double radius = m.facts[0].box_half.y;
  const double h0 = scene.bodies[0].position.y - radius - scene.domain.min.y;
  double left = time_of(m);
  double fall = std::sqrt(2.0 * h0 / g);
  double top = h0;
  double up = 0.0;  // time from the floor to the apex of the present arc
  int bounces = 0;
  while (left >= up + fall && bounces < 1000) {
    left -= up + fall;
    top *= e * e;
    fall = up = std::sqrt(2.0 * top / g);
    ++bounces;
    // Arcs shorter than four steps are rest to a time stepper.
    if (up < 2.0 * m.h) return {};
  }
  const double height = top - 0.5 * g * (left - up) * (left - up);
  const double actual = m.bodies[0].after.x.y - radius - scene.domain.min.y;
  // Each bounce happens up to one step early or late, at the speed of the fall.
  const double speed = std::sqrt(2.0 * g * h0);
  const double limit =
      (1.0 + bounces) * 2.0 * speed * std::pow(m.h, std::min(order, 1.0)) + truncation(0.5 * g, m.h, order, time_of(m));
  return {{"height", "m", std::abs(actual - height), limit}};
}

// Two balls of one mass, head on, e = 1: they change velocities.
Figures billiards(const core::Scene& scene, const Motion& m, double order) {
  const Vec3d v0 = start_velocity(scene);
  const double speed = length(v0);
  const Vec3d along = (1.0 / speed) * v0;
  const Vec3d between = Vec3d(scene.bodies[1].position) - Vec3d(scene.bodies[0].position);
  const double reach = 2.0 * m.facts[0].box_half.x;
  const double ahead = dot(between, along);
  const Vec3d beside = between - ahead * along;
  const double offset = length(beside);
  if (!(offset < reach)) return {};
  const double meets = (ahead - std::sqrt(reach * reach - offset * offset)) / speed;
  const double t = time_of(m);
  if (std::abs(t - meets) < 2.0 * m.h) return {};
  const Vec3d line = (1.0 / reach) * (between - (meets * speed) * along);  // unit, from the first to the second
  const Vec3d given = t < meets ? Vec3d{} : dot(v0, line) * line;
  const double limit = speed * std::pow(speed * m.h / reach, std::min(order, 1.0)) + m.rounding_of(64) * speed;
  return {{"velocity of the first", "m/s", length(m.bodies[0].after.v - (v0 - given)), limit},
          {"velocity of the second", "m/s", length(m.bodies[1].after.v - given), limit}};
}

const std::array<SceneAnswer, 9>& table() {
  static const std::array<SceneAnswer, 9> kTable{{
      {kStands, "nothing moves", "statics; judged by rest",
       [](const core::Scene&, const Motion&, double) { return Figures{}; }},
      {"flight", "x = x0 + v0 t + g t^2 / 2", "Galileo", flight},
      {"torque-free", "Euler's equations of a free body", "Landau and Lifshitz, Mechanics, section 37", torque_free},
      {"incline", "a = g (sin - mu cos), or rest", "Coulomb", incline},
      {"slide", "stops after v0^2 / (2 mu g)", "Coulomb", slide},
      {"slip-to-roll", "rolls at 5/7 v0 from 2 v0 / (7 mu g) on", "Coriolis, Theorie du jeu de billard (1835)",
       slip_to_roll},
      {"roll-incline", "a = 5/7 g sin", "a ball's inertia 2/5 m r^2", roll_incline},
      {"bounce", "apexes e^(2k) h0", "Newton's restitution", bounce},
      {"billiards", "the second takes the component along the line of centers", "Huygens, De motu corporum (1703)",
       billiards},
  }};
  return kTable;
}

}  // namespace

std::span<const SceneAnswer> scene_answers() {
  return table();
}

const SceneAnswer* find_answer(std::string_view name) {
  for (const SceneAnswer& a : table())
    if (a.name == name) return &a;
  return nullptr;
}

}  // namespace broadside::validation

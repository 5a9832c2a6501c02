#include "validation/energy_ledger.hpp"

#include <algorithm>
#include <cmath>

#include "validation/rounding.hpp"
#include "validation/spring_motion.hpp"

namespace broadside::validation {
namespace {

bool has_states(const core::FrameRecord& frame, std::size_t bodies) {
  return frame.position.size() == bodies && frame.velocity.size() == bodies;
}

// Rounded operations in double behind one body's energy (six for the kinetic, seven for gravity's, their sum), and
// behind one spring's.
constexpr double kEnergyOperations = 14.0;
constexpr double kSpringOperations = 11.0;

}  // namespace

EnergyLedger::EnergyLedger(const core::Scene& scene)
    : scene_(scene),
      bodies_(scene),
      gravity_(scene.gravity_m_s2),
      springs_(scene.springs.empty() ? 0 : scene.bodies.size()) {
  for (const core::Spring& s : scene.springs)
    if (s.body < springs_.size()) springs_[s.body].push_back(s);
  for (const auto& of_body : springs_) most_springs_ = std::max(most_springs_, static_cast<double>(of_body.size()));
}

double EnergyLedger::potential(std::uint32_t body, Vec3d x) const {
  double sum = -dot(gravity_, x) / bodies_.inverse_mass(body);
  if (springs_.empty()) return sum;
  for (const core::Spring& s : springs_[body]) {
    const Vec3d reach = x - Vec3d(s.anchor);
    sum += 0.5 * s.stiffness_n_m * dot(reach, reach);
  }
  return sum;
}

double EnergyLedger::energy(std::uint32_t body, Vec3d x, Vec3d v) const {
  return 0.5 * dot(v, v) / bodies_.inverse_mass(body) + potential(body, x);
}

double EnergyLedger::error(std::uint32_t body, Vec3d x, Vec3d v, double off_x, double off_v) const {
  const double m = 1.0 / bodies_.inverse_mass(body);
  double force = m * length(gravity_);
  double stiffness = 0.0;
  if (!springs_.empty())
    for (const core::Spring& s : springs_[body]) {
      force += s.stiffness_n_m * length(x - Vec3d(s.anchor));
      stiffness += s.stiffness_n_m;
    }
  const double kinetic = m * (length(v) * off_v + 0.5 * off_v * off_v);
  return kinetic + force * off_x + 0.5 * stiffness * off_x * off_x;
}

void EnergyLedger::add(EnergyRow& row, double magnitude) {
  row.summed += magnitude;
  row.terms += 1.0;
}

// The rounding of each term by its operations, and of each addition by all terms before it.
double EnergyLedger::double_rounding(const EnergyRow& row) const {
  return 0x1p-53 * (kEnergyOperations + kSpringOperations * most_springs_ + row.terms) * row.summed;
}

void EnergyLedger::integrate(std::uint32_t body, Vec3d x0, Vec3d v0, EnergyRow& row) const {
  const double dt = scene_.dt_s;
  Vec3d a = gravity_;
  double size = length(gravity_);
  if (!springs_.empty())
    for (const core::Spring& s : springs_[body]) {
      const double w = bodies_.inverse_mass(body);
      a = a + (w * s.stiffness_n_m) * (Vec3d(s.anchor) - x0) - (w * s.damping_n_s_m) * v0;
      size += w * (s.stiffness_n_m * length(Vec3d(s.anchor) - x0) + s.damping_n_s_m * length(v0));
    }
  const Vec3d v1 = v0 + dt * a;
  const Vec3d x1 = x0 + dt * v1;
  row.integration += energy(body, x1, v1) - energy(body, x0, v0);
  add(row, std::abs(energy(body, x1, v1)) + std::abs(energy(body, x0, v0)));
  const int operations = acceleration_operations(springs_.empty() ? 0 : springs_[body].size());
  const double off_v = rounding(operations) * dt * size + rounding(1) * length(v1) + 4.0 * kSubnormal;
  const double off_x = rounding(1) * (length(x1) + dt * length(v1)) + dt * off_v + 4.0 * kSubnormal;
  row.rounding += error(body, x1, v1, off_x, off_v);
}

void EnergyLedger::apply(const Application& app, EnergyRow& row) const {
  const core::Contact& c = *app.contact;
  const core::Parameters& p = scene_.parameters;
  const double above = std::max(0.0, static_cast<double>(c.depth_m) - p.delta_m);
  const double magnitude = static_cast<double>(p.alpha) * p.beta * above;
  const Vec3d relative = Vec3d(c.pre_a.v) - Vec3d(c.pre_b.v);
  const double j_n = c.normal_impulse_n_s;
  const double j_t = c.tangent_impulse_n_s;
  const Vec3d t(c.tangent);
  row.normal += j_n * dot(relative, app.normal) + 0.5 * app.w_sum * j_n * j_n * dot(app.normal, app.normal);
  row.friction +=
      j_t * dot(relative, t) + 0.5 * app.w_sum * j_t * j_t * dot(t, t) + app.w_sum * j_n * j_t * dot(t, app.normal);
  const auto side = [&](std::uint32_t body, double w, double sign, const core::Kinematics& pre) {
    if (!(w > 0.0)) return;
    const Vec3d x0(pre.x);
    const Vec3d v0(pre.v);
    const Vec3d moved = (sign * w / app.w_sum * magnitude) * app.normal;
    const Vec3d x1 = x0 + moved;
    const Vec3d v1 = v0 + (sign * w * j_n) * app.normal + (sign * w * j_t) * t;
    row.correction += potential(body, x1) - potential(body, x0);
    add(row, std::abs(potential(body, x1)) + std::abs(potential(body, x0)));
    const double pushed = w * (std::abs(j_n) * length(app.normal) + std::abs(j_t) * length(t));
    const double middle = length(v0 + (sign * w * j_n) * app.normal);
    const double off_v = rounding(2) * pushed + rounding(1) * (middle + length(v1)) + 4.0 * kSubnormal;
    const double off_x = rounding(1) * length(x1) + rounding(7) * length(moved) + 4.0 * kSubnormal;
    row.rounding += error(body, x1, v1, off_x, off_v);
  };
  side(c.a, app.w_a, 1.0, c.pre_a);
  if (!core::is_face(c.b)) side(c.b, app.w_b, -1.0, c.pre_b);
  add(row, std::abs(j_n * dot(relative, app.normal)) + std::abs(j_t * dot(relative, t)) +
               app.w_sum * (std::abs(j_n) + std::abs(j_t)) * (std::abs(j_n) + std::abs(j_t)));
}

// From the velocities after the last contact of each body.
void EnergyLedger::clip(const core::FrameRecord& frame, EnergyRow& row) const {
  std::vector<core::Vec3> left = frame.detected_velocity;
  for (const core::Contact& c : frame.contacts) {
    if (!bodies_.application(c)) continue;
    if (!core::is_face(c.a)) left[c.a] = c.post_a.v;
    if (!core::is_face(c.b)) left[c.b] = c.post_b.v;
  }
  const double v_max = scene_.parameters.v_max_m_s;
  for (std::uint32_t i = 0; i < scene_.body_count(); ++i) {
    const double w = bodies_.inverse_mass(i);
    if (!(w > 0.0)) continue;
    const Vec3d v(left[i]);
    const Vec3d clipped{std::clamp(v.x, -v_max, v_max), std::clamp(v.y, -v_max, v_max), std::clamp(v.z, -v_max, v_max)};
    row.clip += 0.5 * (dot(clipped, clipped) - dot(v, v)) / w;
    if (clipped.x != v.x || clipped.y != v.y || clipped.z != v.z) add(row, dot(v, v) / w);
  }
}

std::optional<EnergyRow> EnergyLedger::row(const core::FrameRecord& frame, const core::FrameRecord* previous) const {
  const std::size_t n = scene_.bodies.size();
  const bool is_first = frame.step == 1;
  if (!has_states(frame, n) || frame.detected_velocity.size() != n || frame.detected_position.size() != n)
    return std::nullopt;
  if (!is_first && (previous == nullptr || previous->step + 1 != frame.step || !has_states(*previous, n)))
    return std::nullopt;
  EnergyRow row;
  row.step = frame.step;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (!(bodies_.inverse_mass(i) > 0.0)) continue;
    const Vec3d x0(is_first ? scene_.bodies[i].position : previous->position[i]);
    const Vec3d v0(is_first ? scene_.bodies[i].velocity : previous->velocity[i]);
    const Vec3d x(frame.position[i]);
    const Vec3d v(frame.velocity[i]);
    integrate(i, x0, v0, row);
    row.kinetic += energy(i, x, v) - potential(i, x);
    row.potential += potential(i, x);
    row.change += energy(i, x, v) - energy(i, x0, v0);
    add(row, std::abs(energy(i, x, v)) + std::abs(energy(i, x0, v0)));
  }
  for (const core::Contact& c : frame.contacts)
    if (const auto app = bodies_.application(c)) apply(*app, row);
  clip(frame, row);
  row.rounding += double_rounding(row);
  return row;
}

}  // namespace broadside::validation

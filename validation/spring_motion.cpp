#include "validation/spring_motion.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace broadside::validation {

double Oscillator::step_limit() const {
  const double half_g = 0.5 * g();
  return 2.0 / (std::sqrt(w0() * w0() + half_g * half_g) + half_g);
}

double Oscillator::amplitude(Vec3d x, Vec3d v) const {
  const Vec3d y = x - rest;
  return std::sqrt(w0() * w0() * dot(y, y) + dot(v, v));
}

std::vector<Oscillator> oscillators(const core::Scene& scene) {
  std::map<std::uint32_t, Oscillator> by_body;
  for (const core::Spring& s : scene.springs) {
    if (s.body >= scene.bodies.size() || !(s.stiffness_n_m > 0.0F || s.damping_n_s_m > 0.0F)) continue;
    Oscillator& o = by_body[s.body];
    o.body = s.body;
    o.w = scene.bodies[s.body].inverse_mass;
    o.stiffness += s.stiffness_n_m;
    o.damping += s.damping_n_s_m;
    o.rest = o.rest + static_cast<double>(s.stiffness_n_m) * Vec3d(s.anchor);
    o.springs.push_back(s);
  }
  std::vector<Oscillator> all;
  for (auto& [body, o] : by_body) {
    if (!(o.w > 0.0)) continue;
    if (o.stiffness > 0.0) o.rest = (1.0 / o.stiffness) * (o.rest + (1.0 / o.w) * Vec3d(scene.gravity_m_s2));
    all.push_back(std::move(o));
  }
  return all;
}

// v' = v - dt (w0^2 y + g v), y' = y + dt v'; as (w0 y, v).
StepPowers::StepPowers(double w0, double g, double dt)
    : step_{1.0 - dt * dt * w0 * w0, dt * w0 * (1.0 - dt * g), -dt * w0, 1.0 - dt * g} {}

void StepPowers::advance() {
  const double a = step_[0] * power_[0] + step_[1] * power_[2];
  const double b = step_[0] * power_[1] + step_[1] * power_[3];
  const double c = step_[2] * power_[0] + step_[3] * power_[2];
  const double d = step_[2] * power_[1] + step_[3] * power_[3];
  power_[0] = a, power_[1] = b, power_[2] = c, power_[3] = d;
  // Largest singular value of a 2 x 2 matrix, in closed form.
  const double square = a * a + b * b + c * c + d * d;
  const double det = a * d - b * c;
  const double norm = std::sqrt(0.5 * (square + std::sqrt(std::max(0.0, square * square - 4.0 * det * det))));
  largest_ = std::max(largest_, norm);
  steps_ += 1.0;
}

}  // namespace broadside::validation

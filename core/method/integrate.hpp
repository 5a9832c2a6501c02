// Time integration, METHOD section 1.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/contact.hpp"
#include "core/math/vec3.hpp"
#include "core/scene/spring.hpp"

namespace broadside::core {

// w F of one spring for P(1): F = -k (x - anchor) - c v.
BROADSIDE_HD Vec3 spring_acceleration(const Spring& spring, const Kinematics& s, float inverse_mass) {
  const Vec3 pull = spring.stiffness_n_m * (spring.anchor - s.x);
  return inverse_mass * (pull - spring.damping_n_s_m * s.v);
}

// P(1) to P(3). The paper says explicit Euler; its position uses the NEW velocity, so it is semi-implicit (symplectic)
// Euler. Gravity is F = m g, so a = w F = g. It is passed as an acceleration, because w * (g / w) would round; springs
// add their accelerations to it.
// A static body (w = 0) is returned unchanged.
BROADSIDE_HD Kinematics semi_implicit_euler(Kinematics s, float inverse_mass, Vec3 acceleration_m_s2, float dt_s) {
  if (!(inverse_mass > 0.0F)) return s;
  s.v = s.v + dt_s * acceleration_m_s2;
  s.x = s.x + dt_s * s.v;
  return s;
}

// Largest stable step of m x'' + c x' + k x = 0 with this integrator, where w0 = sqrt(k/m) and g = c/m.
BROADSIDE_HD double step_limit_sound(double w0, double g) {
  return 2.0 / (sqrt(w0 * w0 + 0.25 * g * g) + 0.5 * g);
}

// P(4) as printed: too large whenever g > 0 (E1).
BROADSIDE_HD double step_limit_printed(double w0, double g) {
  return 2.0 / sqrt(w0 * w0 + 0.25 * g * g);
}

}  // namespace broadside::core

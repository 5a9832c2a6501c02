// Time integration, METHOD section 1.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/contact.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

// P(1) to P(3). The paper says explicit Euler; its position uses the NEW velocity, so it is semi-implicit (symplectic)
// Euler. The only force is gravity, F = m g, so a = w F = g: taken as such, because w * (g / w) would round.
// A static body (w = 0) is returned unchanged.
BROADSIDE_HD Kinematics semi_implicit_euler(Kinematics s, float inverse_mass, Vec3 gravity_m_s2, float dt_s) {
  if (!(inverse_mass > 0.0F)) return s;
  s.v = s.v + dt_s * gravity_m_s2;
  s.x = s.x + dt_s * s.v;
  return s;
}

// Largest stable step of m x'' + c x' + k x = 0 under that rule, with w0 = sqrt(k/m) and g = c/m.
BROADSIDE_HD double step_limit_sound(double w0, double g) {
  return 2.0 / (sqrt(w0 * w0 + 0.25 * g * g) + 0.5 * g);
}

// P(4) as printed: too large whenever g > 0 (E1).
BROADSIDE_HD double step_limit_printed(double w0, double g) {
  return 2.0 / sqrt(w0 * w0 + 0.25 * g * g);
}

}  // namespace broadside::core

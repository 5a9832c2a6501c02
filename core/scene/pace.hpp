// How fast the bodies are at the beginning of a step. It determines in how many parts the step is taken and how
// accurately it is solved (SoftSettings).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "core/math/vec3.hpp"
#include "core/method/rigid/sleep.hpp"
#include "core/method/rigid/stride.hpp"
#include "core/scene/rigid_bodies.hpp"

namespace broadside::core {

// The largest values over all bodies that move; infinite where a number is not finite.
struct Pace {
  float fastest_m_s = 0.0F;  // of any point of a body
  float stride = 0.0F;       // the largest stride of a body
};

// states: by body. dt_s: of the step.
inline Pace pace_of(const RigidBodies& bodies, std::span<const RigidState> states, float dt_s) {
  const auto larger = [](float largest, float v) {
    return std::isfinite(v) ? std::max(largest, v) : std::numeric_limits<float>::infinity();
  };
  Pace pace;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!(bodies.mass[i].inverse_mass > 0.0F)) continue;
    const RigidShape& shape = bodies.shapes[bodies.shape[i]];
    const float fastest_m_s = fastest_of_body_m_s(states[i], bodies.mass[i], shape.balls.outer_m);
    pace.fastest_m_s = larger(pace.fastest_m_s, fastest_m_s);
    pace.stride = larger(pace.stride, stride_of(fastest_m_s, shape.half_thickness_m, dt_s));
  }
  return pace;
}

inline float calm_speed_m_s(Vec3 gravity_m_s2, float dt_s) {
  return 2.0F * dt_s * length(gravity_m_s2);
}

// Whether no point of a body is faster than gravity makes it in two steps. A fast body matters even when it is far from
// the bodies for which this is asked, because within one step a body that it strikes may strike others.
inline bool is_calm(const Pace& pace, Vec3 gravity_m_s2, float dt_s) {
  return pace.fastest_m_s <= calm_speed_m_s(gravity_m_s2, dt_s);
}

}  // namespace broadside::core

// What the soft solver may be set to, and the numbers of a step that follow.
#pragma once

#include <cstdint>

#include "core/math/vec3.hpp"
#include "core/method/rigid/soft_contact.hpp"

namespace broadside::core {

struct SoftSettings {
  std::uint32_t substeps = 8;
  std::uint32_t relax_sweeps = 1;
  float omega_dt = 1.2F;  // of the substep
  float damping = 1.0F;
  float slop_m = 0.0F;
  float fastest_push_m_s = 3.0F;
  float bounce_from_m_s = 0.0F;  // 0 = twice what gravity gives in a step
};

inline SoftStep soft_step_of(const SoftSettings& settings, Vec3 gravity_m_s2, float dt_s) {
  SoftStep step = soft_step(dt_s / static_cast<float>(settings.substeps), settings.omega_dt, settings.damping);
  step.fastest_push_m_s = settings.fastest_push_m_s;
  step.slop_m = settings.slop_m;
  step.bounce_from_m_s =
      settings.bounce_from_m_s > 0.0F ? settings.bounce_from_m_s : 2.0F * dt_s * length(gravity_m_s2);
  return step;
}

}  // namespace broadside::core

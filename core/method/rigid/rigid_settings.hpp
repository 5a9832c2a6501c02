// Settings that octree-cpu and octree-gpu share for bodies that turn.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "core/engine/settings.hpp"
#include "core/method/rigid/soft_settings.hpp"
#include "core/scene/scene.hpp"

namespace broadside::core {

// Reads the settings "contact" and "substeps".
inline SoftSettings soft_settings_of(const Settings& settings) {
  constexpr unsigned long kMostSubsteps = 1024;  // more are below the rounding of a step
  const std::string_view contact = settings.text("contact");
  SoftSettings soft = contact == "soft-step" ? soft_step_settings()
                      : contact == "stiff"   ? stiff_settings()
                                             : SoftSettings{};
  const unsigned long substeps = std::min(settings.number("substeps"), kMostSubsteps);
  return substeps > 0 ? with_substeps(soft, static_cast<std::uint32_t>(substeps)) : soft;
}

// For "thresholds=fixed": the settings with the scene's thresholds, in place of those that scale with bodies, gravity
// and step.
inline SoftSettings with_fixed_thresholds(SoftSettings soft, const Scene& scene) {
  soft.limits.fixed_slop_m = scene.parameters.delta_m;
  soft.fixed_bounce_from_m_s = scene.parameters.v_threshold_m_s;
  return soft;
}

}  // namespace broadside::core

// The scene's coefficients of friction between the two bodies of a point: the geometric mean of the two surfaces
// (DESIGN).
#pragma once

#include <algorithm>
#include <cmath>

#include "core/contact_point.hpp"
#include "core/scene/scene.hpp"

namespace broadside::validation {

struct SceneFriction {
  double fixed = 0.0;
  double sliding = 0.0;

  [[nodiscard]] double larger() const { return std::max(fixed, sliding); }
};

inline SceneFriction scene_friction(const core::Scene& scene, const core::ContactPoint& p) {
  const core::Material& a = scene.bodies[p.a].material;
  const core::Material& b = core::is_face(p.b) ? scene.face_material : scene.bodies[p.b].material;
  const auto mean = [](double x, double y) { return std::sqrt(x * y); };
  return {mean(a.mu_static, b.mu_static), mean(a.mu_kinetic, b.mu_kinetic)};
}

}  // namespace broadside::validation

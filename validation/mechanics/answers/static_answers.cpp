// Scenes that stand, fall, or are reported only.
#include <algorithm>
#include <array>

#include "validation/mechanics/answers/answer_parts.hpp"

namespace broadside::validation {
namespace {

Figures nothing(const core::Scene&, const Motion&, double) {
  return {};
}

// The opposite of rest: by the scene's end some body has moved by a tenth of its smallest side, ten times what a scene
// that stands may settle by.
Figures falls(const core::Scene& scene, const Motion& m, double) {
  constexpr double kShare = 0.1;
  if (m.step < scene.frames) return {};
  double farthest = 0.0;  // in units of what is asked for
  double side = 0.0;
  for (std::size_t i = 0; i < m.bodies.size(); ++i) {
    if (!m.facts[i].is_dynamic) continue;
    const Vec3d start = Vec3d(scene.bodies[i].position) +
                        matrix_of(normalized(to_quatd(scene.bodies[i].orientation))) * m.facts[i].center_of_mass;
    const double needed = kShare * m.facts[i].smallest_side_m;
    farthest = std::max(farthest, length(m.bodies[i].after.x - start) / needed);
    side = std::max(side, needed);
  }
  ExactFigure f{
      .what = "distance that it should have fallen", .unit = "m", .error = std::max(0.0, 1.0 - farthest) * side};
  f.has_order = false;
  return {f};
}

}  // namespace

std::span<const SceneAnswer> static_answers() {
  static const std::array<SceneAnswer, 3> kTable{{
      {kStands, "nothing moves", "statics; judged by rest", nothing},
      {"falls", "it does not stand", "statics", falls},
      {kReported, "no agreed answer", "reported", nothing},
  }};
  return kTable;
}

}  // namespace broadside::validation

#include "validation/mechanics/scene_answer.hpp"

#include <algorithm>

#include "validation/mechanics/answers/answer_parts.hpp"

namespace broadside::validation {

std::span<const SceneAnswer> scene_answers() {
  static const std::vector<SceneAnswer> kAll = [] {
    std::vector<SceneAnswer> all;
    for (const auto& group : {free_answers(), slope_answers(), ball_answers(), impact_answers(), static_answers()})
      all.insert(all.end(), group.begin(), group.end());
    return all;
  }();
  return kAll;
}

const SceneAnswer* find_answer(std::string_view name) {
  for (const SceneAnswer& a : scene_answers())
    if (a.name == name) return &a;
  return nullptr;
}

Plane plane_of(const core::Scene& scene, const Motion& m) {
  const auto meet = [&](const core::Material& other, Vec3d normal) {
    const core::Material& own = scene.bodies[0].material;
    return Plane{normal, std::sqrt(double{own.mu_kinetic} * other.mu_kinetic),
                 std::max(double{own.restitution}, double{other.restitution})};
  };
  for (std::size_t i = 1; i < scene.bodies.size(); ++i)
    if (!m.facts[i].is_dynamic) return meet(scene.bodies[i].material, m.bodies[i].before.r * Vec3d{0.0, 1.0, 0.0});
  return meet(scene.face_material, {0.0, 1.0, 0.0});
}

}  // namespace broadside::validation

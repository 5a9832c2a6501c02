#include "core/method/rigid/rigid_declaration.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <string>

#include "core/method/rigid/step_in_parts.hpp"

namespace broadside::core {

namespace {

bool may_bounce(const Scene& scene) {
  return scene.face_material.restitution > 0.0F ||
         std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Body& b) { return b.material.restitution > 0.0F; });
}

}  // namespace

Declaration rigid_declaration(const SoftSettings& solver, const Scene& scene, Swept swept, std::string_view twin_of) {
  const float ratio = largest_mass_ratio(scene);
  const bool are_swept = !swept_bodies(scene, swept).empty();
  const MostOfStep most = most_of_step(solver, ratio, may_bounce(scene), are_swept);
  const bool is_in_parts = most_parts(solver, ratio, are_swept) > 1;
  std::map<std::string, std::string> given{
      {"motion", "rigid"},
      {"detection_at", is_in_parts ? "within" : "start"},
      {"contacts", "totals"},
      {"integrator", "semi-implicit Euler; Runge-Kutta 4 for orientation, angular momentum constant"},
      {"order", "1"},
      {"substeps", std::to_string(most.substeps)},
      {"iterations", std::to_string(most.applications)},
      {"friction", "cone"},
      {"contact_model", "rigid"},
      {"correction", "position"},
      {"precision", "f32"}};
  if (!twin_of.empty()) given["twin_of"] = twin_of;
  return Declaration::of(given);
}

Declaration with_sleep(const Declaration& declaration, float sleep_speed_m_s) {
  if (!(sleep_speed_m_s > 0.0F)) return declaration;
  const auto& declared = declaration.declared();
  std::map<std::string, std::string> given(declared.begin(), declared.end());
  std::array<char, 32> text{};
  std::to_chars(text.data(), text.data() + text.size() - 1, sleep_speed_m_s);
  given["sleep_speed_m_s"] = text.data();
  return Declaration::of(given);
}

}  // namespace broadside::core

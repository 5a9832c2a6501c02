#include "core/method/rigid/rigid_declaration.hpp"

#include <array>
#include <charconv>
#include <map>
#include <string>

namespace broadside::core {

Declaration rigid_declaration(const SoftSettings& solver, float largest_mass_ratio, std::string_view twin_of) {
  const MostOfStep most = most_of_step(solver, largest_mass_ratio);
  const bool is_in_parts = parts_of_step(solver, largest_mass_ratio) > 1;
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

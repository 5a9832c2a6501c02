// The row of simbody-world: its settings, its declaration and its equivalence card.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "reference/engines.hpp"
#if BROADSIDE_HAS_SIMBODY
#include "reference/rigid_world/solid.hpp"
#include "reference/simbody_world/simbody_world.hpp"
#endif

namespace broadside::reference {
namespace {

constexpr std::string_view kId = "simbody-world";

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 4> kSettings{{
      {"tuning",
       "accurate",
       {"accurate", "shipped"},
       "shipped: accuracy 1e-3 and slip below 1 cm/s, as Simbody ships, whatever accuracy_digits and "
       "slip_speed_um_s say"},
      {"accuracy_digits",
       "8",
       {},
       "accuracy of the error-controlled Runge-Kutta-Merson integrator: 8 is 1e-8; Simbody ships 3"},
      {"stiffness_kpa", "10000", {}, "stiffness of every surface, kPa; 10000 is rubber"},
      {"slip_speed_um_s", "1000", {}, "micrometers/s below which friction fades; Simbody ships 10000"},
  }};
  return kSettings;
}

#if BROADSIDE_HAS_SIMBODY
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

core::EquivalenceCard card_of(const core::Scene& scene, const SimbodyOptions& o) {
  core::EquivalenceCard card = simbody_card();
  for (const auto& mesh : scene.meshes) {
    const Solid solid = solid_of(mesh);
    card.push_back({"shape of " + mesh->name, solid.what, solid.differs});
  }
  const core::Parameters& p = scene.parameters;
  card.push_back({"shape margin", "none", ""});
  card.push_back({"broad-phase margin", "none", ""});
  card.push_back({"warm starting", "none", ""});
  card.push_back({"solver iterations", "none: forces are explicit", "one pass"});
  card.push_back({"contact solver", "none: each contact is a spring and a damper", "one application a contact"});
  card.push_back({"contact margin", "none", ""});
  card.push_back({"domain faces", "six half-spaces", ""});
  card.push_back({"friction rule", "2 a b / (a + b)", "geometric mean"});
  card.push_back({"friction coefficients",
                  "static and kinetic, fading below " + number(o.slip_speed_m_s) + " m/s: what sticks creeps",
                  "rigid"});
  card.push_back(
      {"restitution rule", "dissipation (1 - e) s/m: e of the scene at 1 m/s, nearer to 1 below", "the larger"});
  card.push_back(
      {"contact model",
       "compliant: spheres by Hunt and Crossley, corners of a box as springs, " + number(o.stiffness_pa) + " Pa",
       "rigid"});
  card.push_back({"velocity cap", "none", number(p.v_max_m_s) + " m/s"});
  card.push_back({"rotation", scene.motion == core::Motion::kRigid ? "bodies rotate" : "none: sliding joints", ""});
  card.push_back({"integration", "Runge-Kutta-Merson with error control, accuracy " + number(o.accuracy),
                  "one step of the scene's length"});
  card.push_back({"sleeping", "none", ""});
  return card;
}

core::Result<core::Engine> create(const core::Settings& settings) {
  SimbodyOptions options;
  // Double precision ends at 15 digits.
  options.accuracy = std::pow(10.0, -static_cast<double>(std::clamp(settings.number("accuracy_digits"), 1UL, 15UL)));
  options.stiffness_pa = 1e3 * static_cast<double>(std::max(1UL, settings.number("stiffness_kpa")));
  options.slip_speed_m_s = 1e-6 * static_cast<double>(std::max(1UL, settings.number("slip_speed_um_s")));
  if (settings.text("tuning") == "shipped") {
    options.accuracy = 1e-3;
    options.slip_speed_m_s = 1e-2;
  }

  core::Engine engine;
  engine.id = kId;
  engine.build = simbody_build();
  engine.settings = settings;
  engine.declaration = core::Declaration::of({{"method", "none"},
                                              {"motion", "rigid"},
                                              {"detection_at", "end"},
                                              {"contacts", "none"},
                                              {"integrator", "Runge-Kutta-Merson, error-controlled"},
                                              {"friction", "regularized"},
                                              {"contact_model", "compliant"},
                                              // The accuracy that its integrator is asked for, in place of an order in
                                              // the step.
                                              {"accuracy", number(options.accuracy)},
                                              {"precision", "f64"}});
  engine.dynamics = make_simbody_world(options);
  engine.equivalence = [options](const core::Scene& scene) { return card_of(scene, options); };
  return engine;
}

std::string absent() {
  return {};
}
#else
constexpr const char* kAbsent = "built without Simbody";

core::Result<core::Engine> create(const core::Settings&) {
  return core::Error{kAbsent, std::string(kId), "install libsimbody-dev and configure again", core::Exit::kMissing};
}

std::string absent() {
  return std::string(kAbsent) + ": install libsimbody-dev";
}
#endif

}  // namespace

core::EngineRow simbody_world_row() {
  return {.id = kId,
          .capabilities = "dynamics",
          .what = "Simbody: compliant contacts, an integrator that controls its error",
          .settings = setting_rows(),
          .runs_in_child = true,
          .create = create,
          .absent = absent};
}

}  // namespace broadside::reference

// The row of dart-world: its settings, its declaration and its equivalence card.
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "reference/engines.hpp"
#if BROADSIDE_HAS_DART
#include "reference/dart_world/dart_world.hpp"
#include "reference/rigid_world/solid.hpp"
#endif

namespace broadside::reference {
namespace {

constexpr std::string_view kId = "dart-world";

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 2> kSettings{{
      {"detector",
       "fcl-mesh",
       {"fcl-mesh", "fcl-primitive", "dart"},
       "what finds contacts: FCL on meshes of the shapes, as DART ships, FCL on primitives, or DART's own code"},
      {"solver", "dantzig", {"dantzig", "pgs"}, "solver of impulses: pivoting, or projected Gauss-Seidel"},
  }};
  return kSettings;
}

#if BROADSIDE_HAS_DART
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// Whether any two surfaces of the scene differ in this coefficient.
bool has_unequal(const core::Scene& scene, float core::Material::*coefficient) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const core::Body& b) { return b.material.*coefficient != scene.face_material.*coefficient; });
}

core::EquivalenceCard card_of(const core::Scene& scene, const DartOptions& o) {
  core::EquivalenceCard card = dart_card();
  for (const auto& mesh : scene.meshes) {
    const Solid solid = solid_of(mesh);
    const bool is_meshed = o.detector == DartDetector::kFclMeshes && solid.kind != SolidKind::kBox;
    card.push_back(
        {"shape of " + mesh->name, solid.what + (is_meshed ? ", as a mesh that DART draws" : ""), solid.differs});
  }
  const core::Parameters& p = scene.parameters;
  card.push_back({"shape margin", "none", ""});
  card.push_back({"broad-phase margin", "none", ""});
  card.push_back({"warm starting", "none", ""});
  card.push_back({"solver iterations", "pivoting to the end; projected Gauss-Seidel at most 30", "one pass"});
  card.push_back({"contact margin", "none", ""});
  card.push_back({"domain faces", "six static boxes outside of the domain", ""});
  card.push_back(
      {"friction rule", "the smaller", has_unequal(scene, &core::Material::mu_kinetic) ? "geometric mean" : ""});
  card.push_back({"friction coefficients", "one: the kinetic; a pyramid", "static and kinetic"});
  card.push_back(
      {"restitution rule", "geometric mean", has_unequal(scene, &core::Material::restitution) ? "the larger" : ""});
  card.push_back({"restitution threshold", "0.1 m/s", number(p.v_threshold_m_s) + " m/s"});
  card.push_back({"contact solver",
                  o.is_dantzig ? "boxed LCP by Dantzig's pivoting, Gauss-Seidel where it fails"
                               : "boxed LCP by projected Gauss-Seidel",
                  "one application a contact"});
  card.push_back({"position correction",
                  number(dart_correction_rate()) + " of the depth a step through the velocity, at most " +
                      number(dart_correction_speed_m_s()) + " m/s",
                  number(p.beta * p.alpha) + " of the depth, slop " + number(p.delta_m) + " m"});
  card.push_back({"impulse floor", "none", p.impulse_min_n_s > 0.0F ? number(p.impulse_min_n_s) + " N s" : ""});
  card.push_back({"velocity cap", "none", number(p.v_max_m_s) + " m/s"});
  card.push_back({"rotation", scene.motion == core::Motion::kRigid ? "bodies rotate" : "none: sliding joints", ""});
  card.push_back({"integration", "semi-implicit Euler in body axes; detection before the bodies move",
                  "detection after they move"});
  card.push_back({"sleeping", "none", ""});
  return card;
}

core::Result<core::Engine> create(const core::Settings& settings) {
  DartOptions options;
  if (settings.text("detector") == "fcl-primitive") options.detector = DartDetector::kFclPrimitives;
  if (settings.text("detector") == "dart") options.detector = DartDetector::kOwn;
  options.is_dantzig = settings.text("solver") == "dantzig";

  core::Engine engine;
  engine.id = kId;
  engine.build = dart_build();
  engine.settings = settings;
  engine.declaration = core::Declaration::of({{"method", "none"},
                                              {"motion", "rigid"},
                                              {"detection_at", "start"},
                                              {"contacts", "totals"},
                                              {"integrator", "semi-implicit Euler in body axes"},
                                              {"order", "1"},
                                              {"friction", "pyramid"},
                                              {"contact_model", "rigid"},
                                              {"correction", "velocity"},
                                              {"correction_rate", number(dart_correction_rate())},
                                              {"precision", "f64"}});
  engine.dynamics = make_dart_world(options);
  engine.equivalence = [options](const core::Scene& scene) { return card_of(scene, options); };
  return engine;
}

std::string absent() {
  return {};
}
#else
constexpr const char* kAbsent = "built without DART";

core::Result<core::Engine> create(const core::Settings&) {
  return core::Error{kAbsent, std::string(kId), "install libdart-dev and configure again", core::Exit::kMissing};
}

std::string absent() {
  return std::string(kAbsent) + ": install libdart-dev";
}
#endif

}  // namespace

core::EngineRow dart_world_row() {
  return {.id = kId,
          .capabilities = "dynamics",
          .what = "DART: joints in body axes, FCL's contacts, a boxed LCP",
          .settings = setting_rows(),
          .runs_in_child = true,
          .create = create,
          .absent = absent};
}

}  // namespace broadside::reference

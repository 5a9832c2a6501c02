// The row of ode-world: its settings, its declaration and its equivalence card.
#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "reference/engines.hpp"
#if BROADSIDE_HAS_ODE
#include "reference/ode_world/ode_library.hpp"
#include "reference/ode_world/ode_world.hpp"
#include "reference/rigid_world/solid.hpp"
#endif

namespace broadside::reference {
namespace {

constexpr std::string_view kId = "ode-world";

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 5> kSettings{{
      {"solver", "quick", {"quick", "dantzig"}, "dWorldQuickStep, which iterates, or dWorldStep, which pivots"},
      {"iterations", "20", {}, "iterations of QuickStep; 20 is ODE's default"},
      {"tuning",
       "default",
       {"default", "recommended"},
       "recommended: a surface layer of 0.001 m against jitter, as ODE's manual says"},
      {"gyroscopic", "on", {"on", "off"}, "the gyroscopic torque; ODE's default is on"},
      {"convex", "hull", {"hull", "mesh"}, "convex bodies as ODE's convex geom, or as their triangles"},
  }};
  return kSettings;
}

#if BROADSIDE_HAS_ODE
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string shape_word(const Solid& solid, const OdeOptions& o) {
  if (solid.kind == SolidKind::kConvex) return o.convex_as_mesh ? "triangle mesh" : "convex geom";
  return solid.kind == SolidKind::kMesh ? "triangle mesh" : solid.what;
}

core::EquivalenceCard card_of(const core::Scene& scene, const OdeOptions& o) {
  core::EquivalenceCard card = ode_card();
  for (const auto& mesh : scene.meshes) {
    const Solid solid = solid_of(mesh);
    card.push_back({"shape of " + mesh->name, shape_word(solid, o), solid.differs});
  }
  const core::Parameters& p = scene.parameters;
  card.push_back({"shape margin", "none: the surface layer is separate", ""});
  card.push_back({"broad-phase margin", "none", ""});
  card.push_back({"warm starting", "none", ""});
  card.push_back({"contact margin", "none", ""});
  card.push_back({"domain faces", "six static planes", ""});
  card.push_back({"friction rule", "geometric mean", ""});
  card.push_back({"friction coefficients", "one: the kinetic; a pyramid (dContactApprox1)", "static and kinetic"});
  card.push_back({"restitution rule", "the larger", ""});
  card.push_back({"restitution threshold", number(p.v_threshold_m_s) + " m/s", ""});
  card.push_back({"contact solver",
                  o.is_quick ? "QuickStep: over-relaxed sweeps over all contacts of a step"
                             : "dWorldStep: Dantzig's pivoting, all contacts of an island together",
                  "one application a contact"});
  card.push_back(
      {"solver iterations", o.is_quick ? std::to_string(o.iterations) : std::string("to the end"), "one pass"});
  card.push_back(
      {"position correction",
       number(ode_erp()) + " of the depth a step through the velocity, slop " + number(o.surface_layer_m) + " m",
       number(p.beta * p.alpha) + " of the depth, slop " + number(p.delta_m) + " m"});
  card.push_back({"softness", "constraint force mixing " + number(ode_cfm()), "none"});
  card.push_back({"impulse floor", "none", p.impulse_min_n_s > 0.0F ? number(p.impulse_min_n_s) + " N s" : ""});
  card.push_back({"velocity cap", "none", number(p.v_max_m_s) + " m/s"});
  const bool turns = scene.motion == core::Motion::kRigid;
  card.push_back({"rotation", turns ? "bodies rotate" : "none: infinite inertia", ""});
  if (turns) card.push_back({"gyroscopic torque", o.has_gyroscopic ? "on, as ODE ships" : "left out", ""});
  card.push_back({"integration", "semi-implicit Euler; detection before the bodies move", "detection after they move"});
  card.push_back({"sleeping", "off", ""});
  return card;
}

core::Result<core::Engine> create(const core::Settings& settings) {
  OdeOptions options;
  options.is_quick = settings.text("solver") == "quick";
  options.iterations = static_cast<int>(settings.number("iterations"));
  options.has_gyroscopic = settings.text("gyroscopic") == "on";
  options.convex_as_mesh = settings.text("convex") == "mesh";
  if (settings.text("tuning") == "recommended") options.surface_layer_m = 0.001;

  core::Engine engine;
  engine.id = kId;
  engine.build = ode_build();
  engine.settings = settings;
  engine.declaration = core::Declaration::of(
      {{"method", "none"},
       {"motion", "rigid"},
       {"detection_at", "start"},
       {"contacts", "totals"},
       {"integrator", "semi-implicit Euler"},
       {"order", "1"},
       {"iterations", options.is_quick && options.iterations > 0 ? std::to_string(options.iterations) : "1"},
       {"friction", "pyramid"},
       {"contact_model", "rigid"},
       {"correction", "velocity"},
       {"correction_rate", number(ode_erp())},
       {"precision", "f64"}});
  const auto lcp = std::make_shared<DefectCounter>(Defect::kOdeLcp);
  engine.dynamics = make_ode_world(options, lcp);
  engine.equivalence = [options](const core::Scene& scene) { return card_of(scene, options); };
  engine.defects = defects_of(lcp);
  return engine;
}

std::string absent() {
  return {};
}
#else
constexpr const char* kAbsent = "built without ODE";

core::Result<core::Engine> create(const core::Settings&) {
  return core::Error{kAbsent, std::string(kId), "install libode-dev and configure again", core::Exit::kMissing};
}

std::string absent() {
  return std::string(kAbsent) + ": install libode-dev";
}
#endif

}  // namespace

core::EngineRow ode_world_row() {
  return {.id = kId,
          .capabilities = "dynamics",
          .what = "ODE's world: contact joints, solved by QuickStep or by Dantzig's pivoting",
          .settings = setting_rows(),
          .runs_in_child = true,
          .create = create,
          .absent = absent};
}

}  // namespace broadside::reference

// The row of mujoco-world: its settings, its declaration and its equivalence card.
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "reference/engines.hpp"
#if BROADSIDE_HAS_MUJOCO
#include "reference/mujoco_world/mujoco_world.hpp"
#include "reference/rigid_world/solid.hpp"
#endif

namespace broadside::reference {
namespace {

constexpr std::string_view kId = "mujoco-world";

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 3> kSettings{{
      {"integrator",
       "euler",
       {"euler", "implicit", "rk4"},
       "euler is what MuJoCo ships; with rk4 contacts are not recorded"},
      {"tuning",
       "default",
       {"default", "recommended"},
       "recommended: elliptic cones, friction stiffer than the normal force, many points of convex bodies (see the "
       "card)"},
      {"contact_time_ms", "20", {}, "time constant of contacts (solref), ms; 20 is what MuJoCo ships"},
  }};
  return kSettings;
}

#if BROADSIDE_HAS_MUJOCO
// For elliptic cones: friction is ten times as hard as the normal force. The manual names no number, but says above 1.
constexpr double kHarderFriction = 10.0;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

const char* integrator_word(MujocoIntegrator integrator) {
  if (integrator == MujocoIntegrator::kImplicit) return "implicit in velocity";
  return integrator == MujocoIntegrator::kRungeKutta ? "Runge-Kutta 4" : "semi-implicit Euler";
}

bool has_unequal_friction(const core::Scene& scene) {
  for (const core::Body& b : scene.bodies)
    if (b.material.mu_kinetic != scene.face_material.mu_kinetic) return true;
  return false;
}

core::EquivalenceCard card_of(const core::Scene& scene, const MujocoOptions& o) {
  core::EquivalenceCard card = mujoco_card();
  for (const auto& mesh : scene.meshes) {
    const Solid solid = solid_of(mesh);
    const bool is_hull = solid.kind == SolidKind::kMesh;
    card.push_back({"shape of " + mesh->name, is_hull ? "hull of the vertices" : solid.what,
                    is_hull ? "a mesh that is not convex" : solid.differs});
  }
  const core::Parameters& p = scene.parameters;
  card.push_back({"shape margin", "none", ""});
  card.push_back({"broad-phase margin", "none", ""});
  card.push_back({"warm starting", "from the accelerations of the step before", "none"});
  card.push_back({"solver iterations", "until the gain is below 1e-8, at most 100", "one pass"});
  card.push_back({"contact margin", "none", ""});
  card.push_back({"domain faces", "six static planes", ""});
  card.push_back({"friction rule", "the larger", has_unequal_friction(scene) ? "geometric mean" : ""});
  card.push_back(
      {"friction coefficients",
       std::string("one: the kinetic; ") + (o.has_elliptic_cones ? "elliptic cones" : "pyramids inside the cone"),
       "static and kinetic"});
  card.push_back(
      {"friction impedance", number(o.friction_impedance) + " of the normal one: what sticks creeps", "rigid"});
  bool bounces = scene.face_material.restitution > 0.0F;
  for (const core::Body& b : scene.bodies) bounces = bounces || b.material.restitution > 0.0F;
  card.push_back({"restitution rule", "none: contacts are critically damped springs", bounces ? "the larger" : ""});
  card.push_back({"contact model",
                  "compliant, time constant " +
                      number(std::max(o.contact_time_s, 2.0 * static_cast<double>(scene.dt_s))) +
                      " s, impedance as shipped",
                  "rigid"});
  card.push_back({"contact solver", "Newton, all contacts of a step together", "one application a contact"});
  card.push_back({"points of convex bodies", o.has_many_points ? "several (multiccd)" : "one a pair", ""});
  card.push_back({"velocity cap", "none", number(p.v_max_m_s) + " m/s"});
  const bool turns = scene.motion == core::Motion::kRigid;
  card.push_back({"rotation", turns ? "bodies rotate" : "none: three sliding joints a body", ""});
  card.push_back({"integration", std::string(integrator_word(o.integrator)) + "; detection before the bodies move",
                  "detection after they move"});
  card.push_back({"sleeping", "none", ""});
  return card;
}

core::Result<core::Engine> create(const core::Settings& settings) {
  MujocoOptions options;
  const std::string& integrator = settings.text("integrator");
  if (integrator == "implicit") options.integrator = MujocoIntegrator::kImplicit;
  if (integrator == "rk4") options.integrator = MujocoIntegrator::kRungeKutta;
  options.contact_time_s = 1e-3 * static_cast<double>(std::max(1UL, settings.number("contact_time_ms")));
  if (settings.text("tuning") == "recommended") {
    options.has_elliptic_cones = true;
    options.friction_impedance = kHarderFriction;
    options.has_many_points = true;
  }
  const bool is_runge_kutta = options.integrator == MujocoIntegrator::kRungeKutta;

  core::Engine engine;
  engine.id = kId;
  engine.build = mujoco_build();
  engine.settings = settings;
  engine.declaration =
      core::Declaration::of({{"method", "none"},
                             {"motion", "rigid"},
                             {"detection_at", "start"},
                             {"contacts", is_runge_kutta ? "none" : "totals"},
                             {"integrator", integrator_word(options.integrator)},
                             // Runge-Kutta's quaternions follow an averaged w, so they are of second order (measured).
                             {"order", is_runge_kutta ? "2" : "1"},
                             {"friction", "regularized"},
                             {"contact_model", "compliant"},
                             {"contact_time_s", number(options.contact_time_s)},
                             {"precision", "f64"}});
  const auto boxes = std::make_shared<DefectCounter>(Defect::kMujocoBoxDepth);
  engine.dynamics = make_mujoco_world(options, boxes);
  engine.defects = defects_of(boxes);
  engine.equivalence = [options](const core::Scene& scene) { return card_of(scene, options); };
  return engine;
}

std::string absent() {
  return {};
}
#else
constexpr const char* kAbsent = "built without MuJoCo";

core::Result<core::Engine> create(const core::Settings&) {
  return core::Error{kAbsent, std::string(kId), "install libmujoco-dev and configure again", core::Exit::kMissing};
}

std::string absent() {
  return std::string(kAbsent) + ": install libmujoco-dev";
}
#endif

}  // namespace

core::EngineRow mujoco_world_row() {
  return {.id = kId,
          .capabilities = "dynamics",
          .what = "MuJoCo: compliant contacts, solved by Newton's method",
          .settings = setting_rows(),
          .runs_in_child = true,
          .create = create,
          .absent = absent};
}

}  // namespace broadside::reference

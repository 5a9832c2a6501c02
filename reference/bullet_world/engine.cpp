// The row of bullet-world: its settings and its equivalence card.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionShapes/btCollisionMargin.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/ConstraintSolver/btContactSolverInfo.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include "reference/bullet_margin.hpp"
#include "reference/bullet_world/bullet_world.hpp"
#include "reference/engines.hpp"
#include "reference/vendor_build.hpp"

namespace broadside::reference {
namespace {

constexpr std::string_view kId = "bullet-world";

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// Says which shape each mesh became, and where that shape differs from the mesh.
void add_shapes(const core::Scene& scene, const BulletWorldOptions& options, core::EquivalenceCard& card) {
  for (const auto& mesh : scene.meshes) {
    const BulletShape shape = make_bullet_shape(mesh, options.shapes);
    card.push_back({"shape of " + mesh->name, shape.what, shape.differs});
  }
}

std::string gyroscopic_word(BulletGyroscopic gyroscopic) {
  switch (gyroscopic) {
    case BulletGyroscopic::kImplicitBody:
      return "implicit, in body axes: as Bullet ships";
    case BulletGyroscopic::kImplicitWorld:
      return "implicit, in world axes";
    case BulletGyroscopic::kExplicit:
      return "explicit";
    case BulletGyroscopic::kOff:
      break;
  }
  return "left out";
}

core::EquivalenceCard card_of(const core::Scene& scene, const BulletWorldOptions& o) {
  core::EquivalenceCard card = bullet_card();
  add_shapes(scene, o, card);
  const btContactSolverInfo info;
  const core::Parameters& p = scene.parameters;
  card.push_back(shape_margin_fact(o.shapes.margin_m));
  card.push_back({"contact margin", number(gContactBreakingThreshold) + " m: contacts are kept to this distance", "0"});
  card.push_back({"broad-phase margin",
                  number(gContactBreakingThreshold) + " m a side, and " + number(gDbvtMargin) + " m on moving leaves",
                  "0"});
  card.push_back({"domain faces", "six static planes", ""});
  card.push_back(
      {"friction rule", o.uses_scene_rules ? "geometric mean" : "product", o.uses_scene_rules ? "" : "geometric mean"});
  card.push_back({"friction coefficients", "one: the kinetic", "static and kinetic"});
  card.push_back({"friction directions", o.has_two_frictions ? "two a point" : "one a point, along the slip", ""});
  card.push_back(
      {"restitution rule", o.uses_scene_rules ? "the larger" : "product", o.uses_scene_rules ? "" : "the larger"});
  card.push_back({"restitution threshold", number(p.v_threshold_m_s) + " m/s", ""});
  card.push_back(
      {"contact solver", "sequential impulses, all contacts of a step together", "one application a contact"});
  card.push_back({"solver iterations", std::to_string(o.iterations), "one pass"});
  card.push_back({"warm starting",
                  o.warm_starting ? "on, factor " + number(info.m_warmstartingFactor) : std::string("off"),
                  o.warm_starting ? "off" : ""});
  card.push_back({"position correction",
                  number(info.m_erp2) + " of the depth a step through the velocity, split impulse where deeper than " +
                      number(-info.m_splitImpulsePenetrationThreshold) + " m, slop " + number(info.m_linearSlop) + " m",
                  number(p.beta * p.alpha) + " of the depth, slop " + number(p.delta_m) + " m"});
  card.push_back({"impulse floor", "none", p.impulse_min_n_s > 0.0F ? number(p.impulse_min_n_s) + " N s" : ""});
  card.push_back({"velocity cap", "none", number(p.v_max_m_s) + " m/s"});
  const bool rotates = bullet_world_rotates(scene, o);
  card.push_back({"rotation", rotates ? "bodies rotate" : "none: angular factor 0",
                  o.always_rotates && !bullet_world_rotates(scene, {}) ? "none" : ""});
  if (rotates) card.push_back({"gyroscopic torque", gyroscopic_word(o.gyroscopic), ""});
  card.push_back({"integration", "semi-implicit Euler; detection before the bodies move", "detection after they move"});
  card.push_back({"sleeping", "off", ""});
  return card;
}

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 8> kSettings{{
      {"mesh",
       "gimpact",
       {"gimpact", "hull", "tetrahedra"},
       "bodies that are neither primitive nor convex: their triangles, their hull, or a convex decomposition"},
      {"margin",
       "0",
       {"bullet", core::kMeters},
       "by how much hulls and triangles are thickened: meters, or what Bullet ships (0.04 m)"},
      {"combine",
       "scene",
       {"scene", "bullet"},
       "friction and restitution of two surfaces: the scene's rules or products"},
      {"rotation", "scene", {"scene", "on"}, "scene: bodies do not rotate if none has angular velocity in the scene"},
      {"iterations", "10", {}, "iterations of the contact solver; 10 is Bullet's default"},
      {"gyroscopic",
       "implicit-body",
       {"implicit-body", "implicit-world", "explicit", "off"},
       "how the gyroscopic torque is computed; implicit-body is Bullet's default"},
      {"friction_directions",
       "1",
       {"1", "2"},
       "friction directions of a point; 1, along the slip at the start of a step, is Bullet's default"},
      {"warm_starting",
       "on",
       {"on", "off"},
       "start the solver from the last step's impulses; when off, Bullet keeps none, so contacts are not recorded"},
  }};
  return kSettings;
}

core::Result<core::Engine> create(const core::Settings& settings) {
  BulletWorldOptions options;
  if (settings.text("mesh") == "hull") options.shapes.mesh = BulletMesh::kHull;
  if (settings.text("mesh") == "tetrahedra") options.shapes.mesh = BulletMesh::kTetrahedra;
  options.shapes.margin_m = margin_m_of(settings, CONVEX_DISTANCE_MARGIN);
  options.uses_scene_rules = settings.text("combine") == "scene";
  options.always_rotates = settings.text("rotation") == "on";
  options.iterations = static_cast<int>(settings.number("iterations"));
  options.has_two_frictions = settings.text("friction_directions") == "2";
  options.warm_starting = settings.text("warm_starting") == "on";
  if (settings.text("gyroscopic") == "implicit-world") options.gyroscopic = BulletGyroscopic::kImplicitWorld;
  if (settings.text("gyroscopic") == "explicit") options.gyroscopic = BulletGyroscopic::kExplicit;
  if (settings.text("gyroscopic") == "off") options.gyroscopic = BulletGyroscopic::kOff;

  core::Engine engine;
  engine.id = kId;
  engine.build = bullet_build();
  engine.settings = settings;
  // Bodies turn where the scene's do (bullet_world_rotates), which only the scene can say.
  engine.declaration = core::Declaration::of({{"method", "none"},
                                              {"motion", "rigid"},
                                              {"detection_at", "start"},
                                              {"contacts", options.warm_starting ? "totals" : "none"},
                                              {"integrator", "semi-implicit Euler"},
                                              {"iterations", std::to_string(std::max(1, options.iterations))},
                                              {"friction", "pyramid"},
                                              {"contact_margin_m", number(gContactBreakingThreshold)},
                                              // Down to 0.04 m; deeper overlaps are corrected by split impulses.
                                              {"correction", "velocity"},
                                              {"correction_rate", number(btContactSolverInfo().m_erp2)},
                                              {"precision", "f32"}});
  engine.dynamics = make_bullet_world(options);
  engine.equivalence = [options](const core::Scene& scene) { return card_of(scene, options); };
  return engine;
}

}  // namespace

core::EngineRow bullet_world_row() {
  return {.id = kId,
          .capabilities = "dynamics",
          .what = "Bullet's dynamics world: its broad phase, manifolds and sequential impulses on the same scene",
          .settings = setting_rows(),
          .runs_in_child = true,
          .create = create,
          .absent = [] { return std::string(); }};
}

}  // namespace broadside::reference

#include "reference/plain_rigid/engine.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "reference/vendor_build.hpp"

namespace broadside::reference {
namespace {

constexpr std::string_view kId = "plain-rigid";

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 1> kSettings{{
      {"iterations",
       "300",
       {},
       "at most this many passes of the contact solver, each forward and backward over all points"},
  }};
  return kSettings;
}

core::EquivalenceCard card_of(const core::Scene& scene, const plain::WorldOptions& options) {
  core::EquivalenceCard card = own_card("Broadside, float64", "float64", "none", 1);
  card.push_back({"shape margin", "none", ""});
  card.push_back({"contact margin", "none: a gap may close within the step, no more", ""});
  card.push_back({"broad-phase margin", "how far bodies may move in the step", ""});
  card.push_back({"friction rule", "geometric mean", ""});
  card.push_back({"restitution rule", "the larger of both, applied before gravity acts", ""});
  card.push_back({"contact solver", "projected Gauss-Seidel along conjugate directions, from the step before",
                  "one application a contact"});
  card.push_back(
      {"solver iterations", "until little changes, at most " + std::to_string(options.iterations), "one pass"});
  card.push_back({"position correction", "a fifth of the depth beyond the slop a step, without velocity", ""});
  card.push_back(
      {"rotation", scene.motion == core::Motion::kRigid ? "bodies turn, with the gyroscopic torque" : "none", ""});
  card.push_back({"warm starting", "from the nearest point of the step before", ""});
  card.push_back({"sleeping", "off", ""});
  return card;
}

core::Result<core::Engine> create(const core::Settings& settings) {
  plain::WorldOptions options;
  options.iterations = static_cast<std::uint32_t>(std::max(1UL, settings.number("iterations")));
  core::Engine engine;
  engine.id = kId;
  engine.build = "Broadside, float64";
  engine.settings = settings;
  engine.declaration = plain::declaration(options);
  engine.equivalence = [options](const core::Scene& scene) { return card_of(scene, options); };
  engine.dynamics = std::make_unique<plain::PlainWorld>(options);
  return engine;
}

}  // namespace

core::EngineRow plain_rigid_row() {
  core::EngineRow row;
  row.id = kId;
  row.capabilities = "dynamics";
  row.what = "boxes, spheres and convex meshes that turn: serial, float64, written to be easily checked";
  row.settings = setting_rows();
  row.runs_in_child = false;
  row.create = create;
  return row;
}

namespace plain {

core::Declaration declaration(const WorldOptions& options) {
  return core::Declaration::of(
      {{"motion", "rigid"},
       {"detection_at", "start"},
       {"contacts", "totals"},
       {"integrator", "semi-implicit Euler, exact in free flight; Runge-Kutta 4 for orientation"},
       {"order", "1"},
       // Each iteration changes a velocity three times: forward, backward, and along a conjugate direction.
       {"iterations", std::to_string(3 * options.iterations)},
       {"friction", "cone"},
       {"contact_model", "rigid"},
       {"correction", "position"},
       {"correction_rate", "0.2"},
       {"precision", "f64"}});
}

}  // namespace plain
}  // namespace broadside::reference

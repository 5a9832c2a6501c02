#include "reference/plain_rigid/engine.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>

namespace broadside::reference {
namespace {

constexpr std::string_view kId = "plain-rigid";

std::span<const core::SettingRow> setting_rows() {
  static const std::array<core::SettingRow, 1> rows{{
      {"iterations", "300", {}, "at most so many passes of the contact solver, forward and backward over all points"},
  }};
  return rows;
}

core::Result<core::Engine> create(const core::Settings& settings) {
  plain::WorldOptions options;
  options.iterations = static_cast<std::uint32_t>(std::max(1UL, settings.number("iterations")));
  core::Engine engine;
  engine.id = kId;
  engine.build = "Broadside, float64";
  engine.settings = settings;
  engine.declaration = plain::declaration(options);
  engine.dynamics = std::make_unique<plain::PlainWorld>(options);
  return engine;
}

}  // namespace

core::EngineRow plain_rigid_row() {
  core::EngineRow row;
  row.id = kId;
  row.capabilities = "dynamics";
  row.what = "boxes, spheres and convex meshes that turn: serial, float64, plainly right";
  row.settings = setting_rows();
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
       // Each adds to a velocity forward, backward and along a conjugate direction.
       {"iterations", std::to_string(3 * options.iterations)},
       {"friction", "cone"},
       {"contact_model", "rigid"},
       {"correction", "position"},
       {"correction_rate", "0.2"},
       {"precision", "f64"}});
}

}  // namespace plain
}  // namespace broadside::reference

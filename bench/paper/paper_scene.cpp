#include "bench/paper/paper_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/cell/scene_meshes.hpp"

namespace broadside::bench::paper {
namespace {

// Every body starts with this small gap, in meters, so that float rounding does not start the run in contact.
constexpr double kStartGap_m = 1e-4;

double lowest_m(const core::Scene& scene) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const core::Body& body : scene.bodies) {
    const core::Box box = core::bounds(*scene.meshes[body.mesh]);
    lowest = std::min(lowest, static_cast<double>(box.min.y) + static_cast<double>(body.position.y));
  }
  return lowest;
}

}  // namespace

void fly_to_floor(core::Scene& scene) {
  const double g = -static_cast<double>(scene.gravity_m_s2.y);
  const double drop_m = lowest_m(scene) - static_cast<double>(scene.domain.min.y) - kStartGap_m;
  if (!(g > 0.0) || !(drop_m > 0.0) || !std::isfinite(drop_m)) return;
  // All bodies start at rest, so all fall alike and keep their distances.
  const auto down_m = static_cast<float>(drop_m);
  const auto speed_m_s = static_cast<float>(std::sqrt(2.0 * g * drop_m));
  for (core::Body& body : scene.bodies) {
    body.position.y -= down_m;
    body.velocity.y -= speed_m_s;
  }
}

core::Result<core::Scene> make_paper_scene(const PaperCell& cell, bool allow_stand_in) {
  SceneArguments wanted;
  wanted.spec = cell.scene;
  wanted.frames = static_cast<std::uint32_t>(cell.frames);
  wanted.allow_stand_in = allow_stand_in;
  auto made = make_scene_with_meshes(wanted);
  if (!made || cell.beta <= 0.0) return made;
  core::Scene& scene = made.value();
  scene.name = fmt::format("{}, beta {}, delta {} mm, dt 1 ms", cell.scene, cell.beta, 1e3 * cell.delta_m);
  scene.description += "; it starts when the lowest box reaches the floor";
  scene.dt_s = kPenetrationDt_s;
  scene.parameters.beta = static_cast<float>(cell.beta);
  scene.parameters.delta_m = static_cast<float>(cell.delta_m);
  fly_to_floor(scene);
  if (core::Status s = core::check_scene(scene); !s) return s.error();
  return made;
}

}  // namespace broadside::bench::paper

#include <algorithm>
#include <utility>

#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/stage.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kDropKnobs[] = {
    {"speed_m_s", 1.0, 0.0, 1000.0,
     "speed at which bodies come down, m/s; at 200 they move past the plate in one step"},
    {"thickness", 0.1, 0.01, 1.0, "thickness of the plate, as a share of the longest side"},
};

// Bodies in a row above one plate, which is far above the floor, so that a body that passes through the plate is
// clearly below it.
core::Scene drop(const GivenScene& given) {
  Stage stage(given);
  const double longest = stage.longest();
  const double pitch = 1.2 * longest;
  const double thick = given.knobs[1] * longest;
  const double top = 40.0 * longest;
  for (std::uint32_t n = 0; n < given.count; ++n)
    stage.add_body({n * pitch, top + 0.6 * longest + 0.5 * stage.sides()[1], 0.0}, {0.0, -given.knobs[0], 0.0});
  const double end = std::max(1U, given.count) * pitch;
  stage.add_static_box({-pitch, top - thick, -pitch}, {end, top, pitch});
  auto& cap_m_s = stage.scene().parameters.v_max_m_s;
  cap_m_s = std::max(cap_m_s, static_cast<float>(2.0 * given.knobs[0]));
  return std::move(stage).finish({-2.0 * pitch, 0.0, -2.0 * pitch}, {end + pitch, top + 4.0 * longest, 2.0 * pitch});
}

}  // namespace

SceneFamily drop_family() {
  return {"drop", "drop:MESH:N", "drop:brick:3", "N bodies come down on a thin plate", 120, kDropKnobs, drop};
}

}  // namespace broadside::datasets

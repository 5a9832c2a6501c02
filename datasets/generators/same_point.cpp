#include <utility>

#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/stage.hpp"

namespace broadside::datasets {
namespace {

core::Scene same_point(const GivenScene& given) {
  Stage stage(given);
  stage.scene().gravity_m_s2 = {};
  for (std::uint32_t n = 0; n < given.count; ++n) stage.add_body({0.0, 0.0, 0.0});
  // They move apart along one axis, because for centers at one point only the fixed direction is defined.
  const double half = (given.count + 2.0) * stage.longest();
  return std::move(stage).finish({-half, -half, -half}, {half, half, half});
}

}  // namespace

SceneFamily same_point_family() {
  return {"same-point",
          "same-point:MESH:N",
          "same-point:cube:8",
          "N bodies at one point, without gravity: every pair overlaps",
          300,
          {},
          same_point};
}

}  // namespace broadside::datasets

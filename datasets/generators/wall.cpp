#include <algorithm>
#include <utility>

#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/stage.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kWallKnobs[] = {
    {"speed_m_s", 15.0, 0.0, 50.0, "speed of the projectile, m/s"},
    {"projectile_mass_kg", 10.0, 1e-3, 1e6, "mass of the projectile, kg; the others have 1 kg each"},
};

core::Scene wall(const GivenScene& given) {
  Stage stage(given);
  const Triple& sides = stage.sides();
  const double longest = stage.longest();
  // About as wide as high.
  std::uint32_t columns = 1;
  while (static_cast<double>(columns) * columns * sides[0] < given.count * sides[1]) ++columns;
  const std::uint32_t rows = (given.count + columns - 1) / columns;
  for (std::uint32_t n = 0; n < given.count; ++n) {
    const std::uint32_t row = n / columns;
    // Every other row is shifted by half a body.
    stage.add_body({(n % columns + 0.5 * (row % 2)) * sides[0], (row + 0.5) * sides[1], 0.0});
  }
  const double middle = 0.5 * (columns - 0.5) * sides[0];
  const double height = std::max(1U, rows) * sides[1];
  const double distance = 4.0 * longest;
  stage.add_body({middle, std::max(0.5 * height, 0.5 * sides[1]), -distance}, {0.0, 0.0, given.knobs[0]},
                 given.knobs[1]);
  return std::move(stage).finish({-4.0 * longest, 0.0, -distance - 2.0 * longest},
                                 {(columns + 1) * sides[0] + 4.0 * longest, height + 4.0 * longest, 10.0 * longest});
}

}  // namespace

SceneFamily wall_family() {
  return {
      "wall",     "wall:MESH:N", "wall:brick:40", "a wall of N bodies in running bond, and one more that hits it", 600,
      kWallKnobs, wall};
}

}  // namespace broadside::datasets

#include <utility>

#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/stage.hpp"
#include "datasets/random.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kTowerKnobs[] = {
    {"gap", 0.0, 0.0, 10.0, "gap between bodies, as a share of the longest side"},
    {"offset", 0.1, 0.0, 0.45, "largest shift of a body to the side, as a share of the longest side"},
};

core::Scene tower(const GivenScene& given) {
  Stage stage(given);
  RandomStream random(given.seed);
  const double longest = stage.longest();
  const double pitch = stage.sides()[1] + given.knobs[0] * longest;
  const double offset = given.knobs[1] * longest;
  for (std::uint32_t n = 0; n < given.count; ++n) {
    const double x = random.between(-offset, offset);
    const double z = random.between(-offset, offset);
    stage.add_body({x, n * pitch + 0.5 * stage.sides()[1], z});
  }
  // Leaves room for bodies to fall to the side.
  return std::move(stage).finish({-4.0 * longest, 0.0, -4.0 * longest},
                                 {4.0 * longest, (given.count + 2) * pitch, 4.0 * longest});
}

}  // namespace

SceneFamily tower_family() {
  return {"tower", "tower:MESH:N", "tower:cube:10", "N bodies on top of each other", 600, kTowerKnobs, tower};
}

}  // namespace broadside::datasets

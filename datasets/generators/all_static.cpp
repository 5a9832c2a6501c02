#include <utility>

#include "datasets/cube_root.hpp"
#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/stage.hpp"
#include "datasets/random.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kAllStaticKnobs[] = {
    {"fill", 1.0, 1e-6, 1000.0, "volume of the bodies' boxes over that of the cube"},
};

core::Scene all_static(const GivenScene& given) {
  Stage stage(given);
  RandomStream random(given.seed);
  const Triple& sides = stage.sides();
  const double half = 0.5 * cube_root(given.count * sides[0] * sides[1] * sides[2] / given.knobs[0]);
  for (std::uint32_t n = 0; n < given.count; ++n) {
    Triple center;
    for (double& c : center) c = random.between(-half, half);
    stage.add_body(center, {}, 0.0);
  }
  const double domain = half + stage.longest();
  return std::move(stage).finish({-domain, -domain, -domain}, {domain, domain, domain});
}

}  // namespace

SceneFamily static_family() {
  return {"static",
          "static:MESH:N",
          "static:cube:50",
          "N static bodies at random, many overlapping: no pair, and nothing moves",
          120,
          kAllStaticKnobs,
          all_static};
}

}  // namespace broadside::datasets

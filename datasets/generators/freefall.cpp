#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/scene_options.hpp"
#include "datasets/generators/start_grid.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kFreefallKnobs[] = {
    {"gap", 0.1, 0.0, 100.0, "gap between cells, as a share of the longest side"},
    {"drop_m", 1.0, 0.0, 1e6, "height of the lowest boxes above the floor, m"},
    {"jitter", 0.45, 0.0, 10.0, "largest shift per axis as a share of the gap; below 0.5 no two boxes touch"},
    {"width_of_grid", 2.0, 1.0, 1000.0, "the domain's width, as a multiple of the grid's"},
};

core::Scene freefall(const GivenScene& given) {
  core::Scene scene;
  scene.meshes.push_back(given.model);
  scene.gravity_m_s2 = kGravity;
  const StackedGrid grid{given.knobs[0], given.knobs[1], given.knobs[2], given.knobs[3]};
  place(scene, stacked_grid(core::bounds(*given.model), given.count, grid, given.seed));
  return scene;
}

}  // namespace

SceneFamily freefall_family() {
  return {"freefall",
          "freefall:MESH:N",
          "freefall:bunny:50",
          "free-fall stacking: N bodies from a jittered grid onto the floor",
          kPaperFrames,
          kFreefallKnobs,
          freefall};
}

}  // namespace broadside::datasets

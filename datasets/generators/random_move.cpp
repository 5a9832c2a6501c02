#include "datasets/generators/scene_families.hpp"
#include "datasets/generators/scene_options.hpp"
#include "datasets/generators/start_grid.hpp"

namespace broadside::datasets {
namespace {

constexpr SceneKnob kRandomMoveKnobs[] = {
    // Above a half, the grid of cells rarely fits, and the cube would grow without a notice.
    {"fill", 0.2, 1e-6, 0.5, "share of the cube's volume inside body boxes"},
    {"top_speed_m_s", 5.0, 0.0, 50.0, "speeds are uniform from 0 to this, m/s"},
};

core::Scene random_move(const GivenScene& given) {
  core::Scene scene;
  scene.meshes.push_back(given.model);
  scene.face_material = {.mu_static = 0.0F, .mu_kinetic = 0.0F, .restitution = 1.0F};
  const FilledCube cube{given.knobs[0], given.knobs[1]};
  place(scene, filled_cube(core::bounds(*given.model), given.count, cube, given.seed));
  return scene;
}

}  // namespace

SceneFamily random_move_family() {
  return {"randommove",
          "randommove:MESH:N",
          "randommove:dragon:250",
          "N bodies at random in a closed cube, without gravity",
          kPaperFrames,
          kRandomMoveKnobs,
          random_move};
}

}  // namespace broadside::datasets

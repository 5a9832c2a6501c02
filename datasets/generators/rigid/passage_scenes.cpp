// Bodies so fast that they would be past each other within a step.
#include <array>

#include "datasets/generators/rigid/rigid_parts.hpp"
#include "datasets/generators/rigid/rigid_scenes.hpp"

namespace broadside::datasets {
namespace {

using core::Scene;

// 3.3 m a step against balls of 0.1 m. The velocity cap of the method is out of the way.
Scene fast_balls() {
  Scene scene = rigid_scene("billiards", 1.0 / 60.0, 0.2);
  scene.gravity_m_s2 = {};
  add_ball(scene, 0.05, {-10, 10, 0}).velocity = {200, 0, 0};
  add_ball(scene, 0.05, {0, 10, 0});
  set_surfaces(scene, 0.0, 1.0);
  scene.parameters.v_max_m_s = 1000.0F;
  return scene;
}

// A needle spins about its middle; its tip would swing through a plate of 2 cm within a step.
Scene needle() {
  Scene scene = rigid_scene("first-touch", 1.0 / 60.0, 0.2);
  scene.gravity_m_s2 = {};
  add_box(scene, {2.0, 0.02, 0.02}, {0, 10, 0}).angular_velocity = {0, 0, 20};
  add_box(scene, {2.0, 0.02, 2.0}, {1.5F, 10.8F, 0}, kStaticMass);
  set_surfaces(scene, 0.0, 0.0);
  return scene;
}

constexpr std::array<SmallSceneRow, 2> kRows{{
    {"rigid:two-spheres:fast", "a ball of 0.1 m at 200 m/s meets another one at 1/60 s a step", fast_balls},
    {"rigid:needle-through-plate", "the tip of a spinning needle meets a plate of 2 cm", needle},
}};

}  // namespace

std::span<const SmallSceneRow> passage_scenes() {
  return kRows;
}

}  // namespace broadside::datasets

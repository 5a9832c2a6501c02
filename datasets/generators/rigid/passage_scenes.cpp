// Bodies so fast that they would pass each other within a step.
#include <array>

#include "datasets/generators/rigid/rigid_parts.hpp"
#include "datasets/generators/rigid/rigid_scenes.hpp"

namespace broadside::datasets {
namespace {

using core::Scene;

// 3.3 m a step against balls of 0.1 m. The start is such that steps of 1/60, 1/120, 1/240 and 1/480 s all end beside
// the other ball. The velocity cap of the method is set high enough not to act.
Scene fast_balls() {
  Scene scene = rigid_scene("billiards", 1.0 / 60.0, 0.2);
  scene.gravity_m_s2 = {};
  add_ball(scene, 0.05, {-10.6F, 10, 0}).velocity = {200, 0, 0};
  add_ball(scene, 0.05, {0, 10, 0});
  set_surfaces(scene, 0.0, 1.0);
  scene.parameters.v_max_m_s = 1000.0F;
  return scene;
}

// A needle spins about its middle; without a sweep its tip would swing through a plate of 2 cm within a step.
Scene needle() {
  Scene scene = rigid_scene("first-touch", 1.0 / 60.0, 0.2);
  scene.gravity_m_s2 = {};
  add_box(scene, {2.0, 0.02, 0.02}, {0, 10, 0}).angular_velocity = {0, 0, 20};
  add_box(scene, {2.0, 0.02, 2.0}, {1.5F, 10.8F, 0}, kStaticMass);
  set_surfaces(scene, 0.0, 0.0);
  return scene;
}

// A bullet of 20 mm and 8 g at 300 m/s hits ten free cards of 3 mm and 5 g, one behind the other: 1.25 m a step. A card
// that it strikes becomes as fast, so all bodies are flagged.
Scene bullet() {
  Scene scene = rigid_scene("reported", 1.0 / 240.0, 0.1);
  scene.gravity_m_s2 = {};
  add_ball(scene, 0.01, {-0.7F, 10, 0}, 0.008).velocity = {300, 0, 0};
  for (int k = 0; k < 10; ++k) add_box(scene, {0.003, 0.09, 0.06}, {0.05F * static_cast<float>(k), 10, 0}, 0.005);
  set_surfaces(scene, 0.0, 0.0);
  scene.parameters.v_max_m_s = 1000.0F;
  scene.is_fast.assign(scene.bodies.size(), 1);
  return scene;
}

constexpr std::array<SmallSceneRow, 3> kPassageRows{{
    {"rigid:two-spheres:fast", "a ball of 0.1 m at 200 m/s meets another one at 1/60 s a step", fast_balls},
    {"rigid:needle-through-plate", "the tip of a spinning needle meets a plate of 2 cm", needle},
    {"rigid:bullet-through-cards", "a bullet at 300 m/s meets ten cards of 3 mm: reported; passage", bullet},
}};

}  // namespace

std::span<const SmallSceneRow> passage_scenes() {
  return kPassageRows;
}

}  // namespace broadside::datasets

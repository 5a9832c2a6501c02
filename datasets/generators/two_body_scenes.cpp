#include "datasets/generators/two_body_scenes.hpp"

#include "datasets/generators/scene_options.hpp"
#include "datasets/generators/small_scene_parts.hpp"

namespace broadside::datasets {

core::Scene head_on() {
  core::Scene scene = around_origin(120);
  add(scene, {-1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F});
  add(scene, {1.0F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F});
  return scene;
}

core::Scene unequal() {
  core::Scene scene = around_origin(120);
  add(scene, {-1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, 0.25F);
  add(scene, {1.0F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F});
  return scene;
}

core::Scene glancing() {
  core::Scene scene = around_origin(120);
  add(scene, {-1.0F, 0.0F, 0.0F}, {1.0F, 0.5F, 0.0F});
  add(scene, {1.0F, 0.25F, 0.125F}, {-1.0F, 0.0F, 0.0F});
  return scene;
}

core::Scene resting() {
  core::Scene scene = around_origin(120);
  scene.gravity_m_s2 = kGravity;
  add(scene, {0.0F, -3.5F, 0.0F}, {}, kStatic);
  add(scene, {0.0F, -2.5F, 0.0F}, {});
  return scene;
}

core::Scene oblique() {
  core::Scene scene = around_origin(60);
  // They meet on the x axis in step 31, when after 31/60 s at 4 m/s the first body is level with the second.
  add(scene, {-1.0F, -2.0F, 0.0F}, {1.0F, 4.0F, 0.0F});
  add(scene, {1.0F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F});
  return scene;
}

core::Scene slide() {
  core::Scene scene = over_floor(120);
  add(scene, {-2.0F, 0.5F, 0.0F}, {3.0F, 0.0F, 0.0F});
  return scene;
}

core::Scene rest() {
  core::Scene scene = over_floor(120);
  add(scene, {0.0F, 0.5F, 0.0F}, {});
  return scene;
}

core::Scene stack() {
  core::Scene scene = over_floor(60);
  add(scene, {0.0F, 0.5F, 0.0F}, {});
  add(scene, {0.0F, 1.5F, 0.0F}, {}, 0.001F);
  return scene;
}

core::Scene apart() {
  core::Scene scene = around_origin(60);
  add(scene, {-2.0F, 0.0F, 0.0F}, {});
  add(scene, {2.0F, 0.0F, 0.0F}, {});
  return scene;
}

}  // namespace broadside::datasets

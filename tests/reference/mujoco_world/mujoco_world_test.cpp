// How mujoco-world reports that its library did something other than the scene asks for.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "core/engine/engine.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "reference/engines.hpp"

namespace broadside {
namespace {

core::Engine mujoco_world_engine() {
  const core::EngineRow row = reference::mujoco_world_row();
  auto engine = row.create(core::Settings::parse(row.id, row.settings, {}).value());
  EXPECT_TRUE(engine.ok());
  return std::move(engine).value();
}

// Four unit cubes on the floor.
core::Scene stack() {
  core::Scene scene;
  scene.name = "stack";
  scene.meshes = {std::make_shared<const core::Mesh>(datasets::box_mesh({1, 1, 1}, {1, 1, 1}).value())};
  scene.domain = {{-20, 0, -20}, {20, 40, 20}};
  scene.gravity_m_s2 = {0, -9.81F, 0};
  scene.dt_s = 1.0F / 120.0F;
  scene.motion = core::Motion::kRigid;
  scene.face_material = {0.5F, 0.5F, 0.0F};
  scene.bodies.resize(4);
  for (std::size_t i = 0; i < 4; ++i) {
    scene.bodies[i].position = {0, 0.5F + static_cast<float>(i), 0};
    scene.bodies[i].material = scene.face_material;
  }
  return scene;
}

// Four cubes that rest on each other, tilted by some 1e-7: here MuJoCo 2.2.2 reports a corner a third of a meter deep.
TEST(MujocoWorld, ContactsDeeperThanTheBoxesOverlapAreCounted) {
  if (!reference::mujoco_world_row().absent().empty()) GTEST_SKIP() << "built without MuJoCo";
  const core::Engine engine = mujoco_world_engine();
  core::Scene scene = stack();
  ASSERT_TRUE(engine.dynamics->load(scene).ok());
  for (int k = 0; k < 600; ++k) {
    ASSERT_TRUE(engine.dynamics->step(scene.dt_s).ok());
    core::FrameRecord frame;
    ASSERT_TRUE(engine.dynamics->read_back(frame, core::RecordLevel::kFull).ok());
    std::uint64_t too_deep = 0;
    // Cubes in this pile are never deeper than a tenth of a meter: a deeper point is the defect.
    for (const core::ContactPoint& p : frame.points)
      if (!core::is_face(p.b) && p.gap_m < -0.1F) ++too_deep;
    if (too_deep == 0) continue;
    EXPECT_GE(engine.defects().front().hits, too_deep) << "step " << k + 1;
    return;
  }
  EXPECT_EQ(engine.defects().front().hits, 0U) << "nothing was too deep, and something was counted";
}

// MuJoCo raises friction to 1e-5; a scene without friction has none.
TEST(MujocoWorld, SurfacesWithoutFrictionDoNotBrake) {
  if (!reference::mujoco_world_row().absent().empty()) GTEST_SKIP() << "built without MuJoCo";
  const core::Engine engine = mujoco_world_engine();
  core::Scene scene = stack();
  scene.bodies.resize(1);
  scene.bodies[0].material = scene.face_material = {0.0F, 0.0F, 0.0F};
  scene.bodies[0].velocity = {1, 0, 0};
  ASSERT_TRUE(engine.dynamics->load(scene).ok());
  for (int k = 0; k < 120; ++k) ASSERT_TRUE(engine.dynamics->step(scene.dt_s).ok());
  core::FrameRecord frame;
  ASSERT_TRUE(engine.dynamics->read_back(frame, core::RecordLevel::kFull).ok());
  ASSERT_FALSE(frame.points.empty());
  // 1e-5 of the weight for a second would take 1e-4 m/s.
  EXPECT_NEAR(frame.wide.velocity[0].x, 1.0, 1e-9);
  for (const core::ContactPoint& p : frame.points) EXPECT_LT(std::hypot(p.impulse.x, p.impulse.z), 1e-12F);
}

// As shipped, the library would restart the scene from its first state, and go on as if nothing had happened.
TEST(MujocoWorld, AStateThatIsTooFastEndsTheStepWithItsWarning) {
  if (!reference::mujoco_world_row().absent().empty()) GTEST_SKIP() << "built without MuJoCo";
  const core::Engine engine = mujoco_world_engine();
  core::Scene scene = stack();
  scene.bodies[0].velocity = {1e12F, 0, 0};
  ASSERT_TRUE(engine.dynamics->load(scene).ok());
  const core::Status stepped = engine.dynamics->step(scene.dt_s);
  ASSERT_FALSE(stepped.ok());
  EXPECT_NE(stepped.error().what.find("MuJoCo warned"), std::string::npos) << stepped.error().line();
  EXPECT_EQ(stepped.error().exit, core::Exit::kMissing);
}

}  // namespace
}  // namespace broadside

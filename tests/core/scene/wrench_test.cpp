// Wrenches of a scene: what is refused, what the digest covers, and scenes that are transformed with them.
#include <gtest/gtest.h>

#include <memory>

#include "core/scene/refuse_wrenches.hpp"
#include "core/scene/transformed_scene.hpp"
#include "datasets/shapes/box_mesh.hpp"

namespace broadside::tests {
namespace {

using core::Scene;
using core::WrenchAxes;

Scene pushed_box() {
  Scene scene;
  scene.name = "test";
  scene.meshes = {std::make_shared<const core::Mesh>(datasets::box_mesh({0.5, 1.0, 2.0}, {1, 1, 1}).value())};
  scene.domain = {{-1, -2, -3}, {4, 5, 6}};
  scene.gravity_m_s2 = {1, 2, 3};
  scene.motion = core::Motion::kRigid;
  scene.bodies.resize(2);
  scene.bodies[0].orientation = {0.5F, 0.5F, -0.5F, 0.5F};
  scene.bodies[0].velocity = {1, 0, 2};
  scene.bodies[0].angular_velocity = {3, 4, 5};
  scene.bodies[1].position = {0, 3, 1};
  scene.mass_properties = {{{0.1, 0.2, 0.3}, {1, 1.25, 1.5, 0.0625, 0.125, 0.1875}}, {{}, {1, 1, 1, 0, 0, 0}}};
  scene.wrenches = {{0, WrenchAxes::kWorld, {1, 2, 3}, {4, 5, 6}}, {1, WrenchAxes::kBody, {0, 1, 0}, {}}};
  return scene;
}

std::string refusal(const Scene& scene) {
  const core::Status s = core::check_scene(scene);
  return s ? "" : s.error().line();
}

TEST(Wrench, WhatNoBodyCanBeGivenIsRefused) {
  EXPECT_EQ(refusal(pushed_box()), "");
  Scene scene = pushed_box();
  scene.wrenches[1].body = 2;
  EXPECT_NE(refusal(scene).find("wrench 1: its body does not exist"), std::string::npos) << refusal(scene);
  scene = pushed_box();
  scene.bodies[0].inverse_mass = 0.0F;
  EXPECT_NE(refusal(scene).find("its body is static"), std::string::npos) << refusal(scene);
  scene = pushed_box();
  scene.wrenches[0].torque_n_m.x = std::numeric_limits<float>::infinity();
  EXPECT_NE(refusal(scene).find("torque is NaN or infinite"), std::string::npos) << refusal(scene);
  scene = pushed_box();
  scene.wrenches[0].axes = static_cast<WrenchAxes>(7);
  EXPECT_NE(refusal(scene).find("axes"), std::string::npos) << refusal(scene);
  scene = pushed_box();
  scene.motion = core::Motion::kTranslate;
  EXPECT_NE(refusal(scene).find("it has a torque"), std::string::npos) << refusal(scene);
}

TEST(Wrench, TheDigestSeesEachPartAndASceneWithoutKeepsItsOwn) {
  const Scene scene = pushed_box();
  Scene other = scene;
  other.wrenches[1].axes = WrenchAxes::kWorld;
  EXPECT_NE(core::scene_digest(scene), core::scene_digest(other));
  other = scene;
  other.wrenches[0].torque_n_m.z = 7;
  EXPECT_NE(core::scene_digest(scene), core::scene_digest(other));
  other = scene;
  other.wrenches.clear();
  EXPECT_NE(core::scene_digest(scene), core::scene_digest(other));
}

TEST(Wrench, AnEngineThatKnowsNoneSaysSoAndTheCellIsMissing) {
  Scene scene = pushed_box();
  const core::Status refused = core::refuse_wrenches(scene);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().exit, core::Exit::kMissing);
  EXPECT_NE(refused.error().line().find("unsupported: wrench"), std::string::npos);
  scene.wrenches.clear();
  EXPECT_TRUE(core::refuse_wrenches(scene).ok());
}

TEST(Wrench, ScenesThatComeBackAreTheSame) {
  const Scene scene = pushed_box();
  const std::uint64_t digest = core::scene_digest(scene);
  EXPECT_EQ(core::scene_digest(core::scaled_scene(core::scaled_scene(scene, 2.0F), 0.5F)), digest);
  for (const int axis : {0, 1, 2}) {
    EXPECT_EQ(core::scene_digest(core::mirrored_scene(core::mirrored_scene(scene, axis), axis)), digest);
    Scene turned = scene;
    for (int k = 0; k < 4; ++k) {
      turned = core::turned_scene(turned, axis);
      EXPECT_EQ(refusal(turned), "");
      EXPECT_EQ(core::scene_digest(turned) == digest, k == 3) << axis << " " << k;
    }
  }
}

// Twice the lengths at the same mass and times: twice the force, four times the torque.
TEST(Wrench, ScalingFollowsTheUnits) {
  const Scene twice = core::scaled_scene(pushed_box(), 2.0F);
  EXPECT_EQ(twice.wrenches[0].force_n, (core::Vec3{2, 4, 6}));
  EXPECT_EQ(twice.wrenches[0].torque_n_m, (core::Vec3{16, 20, 24}));
}

// A turn about z takes x to y; a torque turns like a vector, and a mirror flips what lies in it.
TEST(Wrench, TurnsAndMirrorsAreThoseOfVectorsAndMoments) {
  const Scene turned = core::turned_scene(pushed_box(), 2);
  EXPECT_EQ(turned.wrenches[0].force_n, (core::Vec3{-2, 1, 3}));
  EXPECT_EQ(turned.wrenches[0].torque_n_m, (core::Vec3{-5, 4, 6}));
  EXPECT_EQ(turned.domain.min, (core::Vec3{-5, -1, -3}));
  EXPECT_EQ(turned.mass_properties[0].inertia_kg_m2, (std::array<double, 6>{1.25, 1, 1.5, -0.0625, -0.1875, 0.125}));
  const Scene mirrored = core::mirrored_scene(pushed_box(), 0);
  EXPECT_EQ(mirrored.wrenches[0].force_n, (core::Vec3{-1, 2, 3}));
  EXPECT_EQ(mirrored.wrenches[0].torque_n_m, (core::Vec3{4, -5, -6}));
}

}  // namespace
}  // namespace broadside::tests

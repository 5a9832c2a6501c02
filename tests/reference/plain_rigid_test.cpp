// plain-rigid against closed forms, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/capsule_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"
#include "reference/plain_rigid/plain_world.hpp"

namespace broadside::tests {
namespace {

using core::FrameRecord;
using core::Scene;
using reference::plain::PlainWorld;

std::shared_ptr<const core::Mesh> shared(core::Result<core::Mesh> mesh) {
  return std::make_shared<const core::Mesh>(std::move(mesh).value());
}

Scene world(std::shared_ptr<const core::Mesh> mesh, float dt_s, std::uint32_t frames) {
  Scene scene;
  scene.name = "test";
  scene.meshes = {std::move(mesh)};
  scene.domain = {{-50, 0, -50}, {50, 100, 50}};
  scene.gravity_m_s2 = {0, -10, 0};
  scene.dt_s = dt_s;
  scene.frames = frames;
  scene.motion = core::Motion::kRigid;
  scene.bodies.resize(1);
  return scene;
}

// The frame after the scene's last step.
FrameRecord last_frame(const Scene& scene) {
  PlainWorld engine({100});
  FrameRecord frame;
  const core::Status loaded = engine.load(scene);
  EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? "" : loaded.error().line());
  for (std::uint32_t k = 0; k < scene.frames; ++k) EXPECT_TRUE(engine.step(scene.dt_s).ok());
  EXPECT_TRUE(engine.read_back(frame, core::RecordLevel::kFull).ok());
  return frame;
}

// Its angular velocity has the period of Jacobi's functions, 6.05684 s (RIGID 6, checked there by integration).
TEST(PlainRigid, AFreeBrickRepeatsItsAngularVelocityAfterThePeriod) {
  Scene scene = world(shared(datasets::box_mesh({0.1, 0.4, 0.9}, {1, 1, 1})), 6.05684F / 6000.0F, 6000);
  scene.gravity_m_s2 = {};
  scene.bodies[0].position = {0, 50, 0};
  scene.bodies[0].inverse_mass = 0.1F;
  scene.bodies[0].angular_velocity = {0.1F, 5.0F, 0.1F};
  const FrameRecord frame = last_frame(scene);
  // In body axes.
  const core::WideQuat q = frame.wide.orientation[0];
  const core::WideVec3 w = frame.wide.angular_velocity[0];
  const core::Vec3 local = core::rotate(
      {static_cast<float>(q.w), static_cast<float>(-q.x), static_cast<float>(-q.y), static_cast<float>(-q.z)},
      core::narrowed(w));
  EXPECT_NEAR(local.x, 0.1, 2e-3);
  EXPECT_NEAR(local.y, 5.0, 2e-3);
  EXPECT_NEAR(local.z, 0.1, 2e-3);
}

TEST(PlainRigid, FreeFlightIsTheParabola) {
  Scene scene = world(shared(datasets::sphere_mesh(0.5, 4)), 0.125F, 8);
  scene.bodies[0].position = {0, 50, 0};
  scene.bodies[0].velocity = {3, 1, 0};
  const FrameRecord frame = last_frame(scene);
  EXPECT_NEAR(frame.wide.position[0].x, 3.0, 1e-12);
  EXPECT_NEAR(frame.wide.position[0].y, 50.0 + 1.0 - 5.0, 1e-12);
}

TEST(PlainRigid, ABoxSlidesAsFarAsFrictionLetsItInEveryHeading) {
  for (const float heading : {0.0F, 0.4F, 0.7854F, 1.2F}) {
    Scene scene = world(shared(datasets::box_mesh({1, 0.25, 1}, {1, 1, 1})), 1.0F / 240.0F, 480);
    scene.bodies[0].position = {0, 0.125F, 0};
    scene.bodies[0].velocity = {4.0F * std::cos(heading), 0, 4.0F * std::sin(heading)};
    scene.bodies[0].material = scene.face_material = {0.5F, 0.5F, 0.0F};
    const FrameRecord frame = last_frame(scene);
    const double slid = std::hypot(frame.wide.position[0].x, frame.wide.position[0].z);
    EXPECT_NEAR(slid, 16.0 / (2 * 0.5 * 10), 0.02) << heading;
    EXPECT_LT(std::abs(frame.wide.velocity[0].x), 1e-6);
  }
}

TEST(PlainRigid, ASlippingBallRollsAtFiveSevenths) {
  Scene scene = world(shared(datasets::sphere_mesh(0.5, 4)), 1.0F / 480.0F, 480);
  scene.bodies[0].position = {0, 0.5F, 0};
  scene.bodies[0].velocity = {3.5F, 0, 0};
  scene.bodies[0].material = scene.face_material = {0.4F, 0.4F, 0.0F};
  const FrameRecord frame = last_frame(scene);
  EXPECT_NEAR(frame.wide.velocity[0].x, 2.5, 0.01);
  EXPECT_NEAR(frame.wide.angular_velocity[0].z, -2.5 / 0.5, 0.02);
}

TEST(PlainRigid, AnElasticBallKeepsItsEnergy) {
  Scene scene = world(shared(datasets::sphere_mesh(0.5, 4)), 1.0F / 120.0F, 1200);
  scene.bodies[0].position = {0, 2.5F, 0};
  scene.bodies[0].material.restitution = 1.0F;
  const FrameRecord frame = last_frame(scene);
  const double v = frame.wide.velocity[0].y;
  EXPECT_NEAR(0.5 * v * v + 10.0 * frame.wide.position[0].y, 25.0, 1e-6);
}

// A cube of 1 kg, so that its moment is 1/6 kg m^2 at any orientation, J.
double energy_of_cube(core::WideVec3 v, core::WideVec3 w) {
  return 0.5 * (v.x * v.x + v.y * v.y + v.z * v.z) + (w.x * w.x + w.y * w.y + w.z * w.z) / 12.0;
}

// Newton's restitution with friction adds energy to a cube that lands askew while it spins. Once, energy that a heavy
// ball far away lost in the same step made up for that gain.
TEST(PlainRigid, NoBodyGainsWhatOthersLoseInTheSameStep) {
  for (int k = 0; k < 64; ++k) {
    const float angle = 0.1F * static_cast<float>(k);
    Scene scene = world(shared(datasets::box_mesh({1, 1, 1}, {1, 1, 1})), 1.0F / 60.0F, 1);
    scene.gravity_m_s2 = {};
    scene.meshes.push_back(shared(datasets::sphere_mesh(0.5, 4)));
    scene.bodies.resize(2);
    scene.bodies[0].orientation = {std::cos(angle), 0.6F * std::sin(angle), 0, 0.8F * std::sin(angle)};
    scene.bodies[0].position = {0, 0.85F, 0};
    scene.bodies[0].velocity = {2, -4, 0};
    scene.bodies[0].angular_velocity = {12, 3, 12};
    scene.bodies[0].material = {0.5F, 0.375F, 0.8F};
    scene.bodies[1].mesh = 1;
    scene.bodies[1].position = {20, 0.5F, 0};
    scene.bodies[1].velocity = {0, -10, 0};
    scene.bodies[1].inverse_mass = 0.01F;
    const FrameRecord frame = last_frame(scene);
    const double before = energy_of_cube({2, -4, 0}, {12, 3, 12});
    const double after = energy_of_cube(frame.wide.velocity[0], frame.wide.angular_velocity[0]);
    // Rounding of some hundred sweeps of float64 additions.
    EXPECT_LE(after, before * (1.0 + 0x1p-44)) << angle;
  }
}

// Before the blow the cube is at rest 0.2 m above the floor; the ball drives it at 20 m/s, 0.33 m in a step.
TEST(PlainRigid, WhatIsStruckStopsAtTheFloorInTheSameStep) {
  Scene scene = world(shared(datasets::box_mesh({1, 1, 1}, {1, 1, 1})), 1.0F / 60.0F, 1);
  scene.gravity_m_s2 = {};
  scene.meshes.push_back(shared(datasets::sphere_mesh(0.5, 4)));
  scene.bodies.resize(2);
  scene.bodies[0].position = {0, 0.7F, 0};
  scene.bodies[1].mesh = 1;
  scene.bodies[1].position = {0, 1.8F, 0};
  scene.bodies[1].velocity = {0, -20, 0};
  scene.bodies[1].inverse_mass = 0.1F;
  const FrameRecord frame = last_frame(scene);
  EXPECT_LT(frame.wide.position[0].y, 0.7);
  // Sweeps end at 2^-18 of the fastest, here 20 m/s.
  EXPECT_GE(frame.wide.position[0].y, 0.5 - 20.0 * 0x1p-18 / 60.0);
}

TEST(PlainRigid, AStackStandsAndItsLowestPointsCarryTheWeight) {
  Scene scene = world(shared(datasets::box_mesh({1, 1, 1}, {1, 1, 1})), 1.0F / 60.0F, 300);
  scene.bodies.resize(4);
  for (std::size_t i = 0; i < 4; ++i) scene.bodies[i].position = {0, 0.5F + static_cast<float>(i), 0};
  const FrameRecord frame = last_frame(scene);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(frame.wide.position[i].y, 0.5 + static_cast<double>(i), 1e-3) << i;
    EXPECT_NEAR(frame.wide.position[i].x, 0.0, 1e-3) << i;
  }
  double carried = 0.0;
  for (const core::ContactPoint& p : frame.points)
    if (core::is_face(p.b)) carried += p.impulse.y;
  EXPECT_NEAR(carried, 4 * 10.0 / 60.0, 1e-3);
}

TEST(PlainRigid, TwoRunsHaveTheSameBits) {
  Scene scene = world(shared(datasets::box_mesh({1, 0.5, 0.75}, {1, 1, 1})), 1.0F / 60.0F, 120);
  scene.bodies.resize(6);
  for (std::size_t i = 0; i < 6; ++i) {
    scene.bodies[i].position = {0.3F * static_cast<float>(i), 1.0F + static_cast<float>(i), 0.2F};
    scene.bodies[i].angular_velocity = {1.0F, static_cast<float>(i), -2.0F};
  }
  EXPECT_EQ(last_frame(scene).digest, last_frame(scene).digest);
}

TEST(PlainRigid, AShapeThatItDoesNotKnowIsNamed) {
  Scene scene = world(shared(datasets::capsule_mesh(0.25, 0.5, 8)), 1.0F / 60.0F, 1);
  PlainWorld engine({100});
  const core::Status loaded = engine.load(scene);
  ASSERT_FALSE(loaded.ok());
  EXPECT_NE(loaded.error().line().find("unsupported: capsule"), std::string::npos) << loaded.error().line();
  EXPECT_EQ(loaded.error().exit, core::Exit::kMissing);
}

}  // namespace
}  // namespace broadside::tests

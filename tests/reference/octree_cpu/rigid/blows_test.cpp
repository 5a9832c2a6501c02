// What a blow, or an impulse that was taken back, leaves behind.
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "core/contact.hpp"
#include "datasets/scenes.hpp"
#include "tests/reference/octree_cpu/rigid/pipeline_rig.hpp"

namespace broadside::tests {
namespace {

using core::FrameRecord;
using core::Vec3;

PipelineRig rig_of(const char* name) {
  PipelineRig rig;
  auto scene = datasets::make_scene(name);
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().line());
  rig.scene = std::move(scene).value();
  return rig;
}

double energy_j(const core::Scene& scene, const FrameRecord& frame, std::size_t body) {
  const double mass_kg = 1.0 / static_cast<double>(scene.bodies[body].inverse_mass);
  const Vec3 v = frame.velocity[body];
  return mass_kg * (0.5 * core::dot(v, v) - core::dot(scene.gravity_m_s2, frame.position[body]));
}

// 8 kg fall at 7.5 m/s on a cube of 16 g that lies on the floor, come to rest, and stay there: before, the floor's push
// of that blow began the next substep, and they left with 17 J.
TEST(Blows, ABlowThroughALightBodyIsNoLoadOfTheNextSubstep) {
  const PipelineRig rig = rig_of("mixed-sizes:cube:60[rigid=1,seed=3]");
  const std::vector<FrameRecord> frames = rig.run(50);
  constexpr std::size_t kHeavy = 26;
  ASSERT_FLOAT_EQ(rig.scene.bodies[kHeavy].inverse_mass, 1.0F / 8.0F);
  EXPECT_LT(frames[45].velocity[kHeavy].y, -7.0F) << "it comes fast";
  for (std::size_t k = 46; k < frames.size(); ++k)
    EXPECT_LT(energy_j(rig.scene, frames[k], kHeavy) - energy_j(rig.scene, frames[k - 1], kHeavy), 1.0) << k + 1;
}

// Nobody told of an impulse has a velocity, to the last bit: there is no gravity.
TEST(Blows, WhatWasGivenAndTakenBackLeavesNothing) {
  PipelineRig rig = rig_of("rigid:bullet-through-cards");
  rig.options.swept = core::Swept::kNobody;
  const FrameRecord frame = rig.run(1).front();
  std::vector<std::uint8_t> is_pushed(frame.velocity.size(), 0);
  for (const core::ContactPoint& p : frame.points) {
    if (p.impulse == Vec3{}) continue;
    is_pushed[p.a] = 1;
    if (!core::is_face(p.b)) is_pushed[p.b] = 1;
  }
  int untouched = 0;
  for (std::size_t i = 0; i < frame.velocity.size(); ++i) {
    if (is_pushed[i] != 0) continue;
    ++untouched;
    EXPECT_EQ(frame.velocity[i], Vec3{}) << i;
    EXPECT_EQ(frame.angular_velocity[i], Vec3{}) << i;
  }
  EXPECT_GT(untouched, 0);
}

}  // namespace
}  // namespace broadside::tests

// What remains after a blow, and after an impulse that was taken back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

// A body that received no impulse has no velocity, to the last bit: there is no gravity.
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

// A row of cubes of 25 cm and 1 kg on the floor, with these gaps; a cube of 4 kg strikes the first one at 20 m/s.
// Returns the depth of the deepest point afterwards, m.
float deepest_of_row(const std::vector<float>& gaps_m) {
  PipelineRig rig;
  const std::uint32_t cube = rig.box(0.25, 0.25, 0.25);
  rig.add(cube, {-1.15F, 0.125F, 0.0F}, 4.0F, {20.0F, 0.0F, 0.0F});
  float x = 0.0F;
  rig.add(cube, {x, 0.125F, 0.0F}, 1.0F);
  for (const float gap : gaps_m) rig.add(cube, {x += 0.25F + gap, 0.125F, 0.0F}, 1.0F);
  float deepest_m = 0.0F;
  for (const FrameRecord& frame : rig.run(12))
    for (const core::ContactPoint& p : frame.points) deepest_m = std::max(deepest_m, -p.gap_m);
  return deepest_m;
}

// Before, the last two cubes of a row ended 17 cm deep in each other: the last one could not learn in time of a blow
// that comes through five others.
TEST(Blows, PassThroughARowThatTouches) {
  EXPECT_LT(deepest_of_row({2e-4F, 2e-4F, 2e-4F, 2e-4F, 2e-4F}), 0.005F);
}

// Before, cubes ended 13 cm deep.
TEST(Blows, PassThroughARowWithGaps) {
  EXPECT_LT(deepest_of_row({0.03F, 0.03F, 0.03F, 0.03F, 0.03F}), 0.005F);
}

// Before, cubes ended 2.4 cm deep: the second cube learned of the blow only in the step in which it was struck.
TEST(Blows, ArePassedOnToWhatIsBeyondTheNextOne) {
  EXPECT_LT(deepest_of_row({2e-4F, 0.05F}), 0.005F);
}

// The edge of a needle that spins in its plane comes down on a plate within a step, and there is no gravity. Before,
// one end of the edge bore almost twice what the other bore, and the needle went on with 390 and 523 rad/s about x and
// y.
TEST(Blows, AreSharedByTheEndsOfAnEdge) {
  PipelineRig rig = rig_of("rigid:needle-through-plate");
  rig.scene.dt_s = 1.0F / 120.0F;
  const FrameRecord frame = rig.run(24).back();
  EXPECT_LT(std::abs(frame.angular_velocity[0].x), 1.0F);
  EXPECT_LT(std::abs(frame.angular_velocity[0].y), 1.0F);
  EXPECT_GT(frame.angular_velocity[0].z, 5.0F);  // what the blow leaves of 20
  EXPECT_LT(frame.angular_velocity[0].z, 12.0F);
}

// One cube is about to drive a second one toward a third that falls past it, but not far enough to meet it. Before, the
// plane through the corner stopped the falling cube.
TEST(Blows, DoNotStopWhoFallsPast) {
  PipelineRig rig;
  const std::uint32_t cube = rig.box(1.0, 1.0, 1.0);
  constexpr float kFalls_m = 0.0694F;  // in the first step, in which no body knows of the push yet
  rig.add(cube, {0.0F, 1.52F + kFalls_m, 0.0F}, 1.0F, {0.0F, -4.0F, 0.0F});
  rig.add(cube, {1.028F, 0.5F, 0.0F}, 1.0F);
  rig.add(cube, {2.15F, 0.5F, 0.0F}, 1.0F, {-4.0F, 0.0F, 0.0F});
  const FrameRecord frame = rig.run(2).back();
  EXPECT_NEAR(frame.velocity[0].y, -4.0F - 2.0F * 9.81F / 60.0F, 1e-4F);
  EXPECT_EQ(frame.velocity[0].x, 0.0F);
  EXPECT_LT(frame.velocity[1].x, -1.0F);
}

}  // namespace
}  // namespace broadside::tests

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

// A row of dominoes, of which the first is tipped over.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "datasets/scenes.hpp"
#include "tests/reference/octree_cpu/rigid/pipeline_rig.hpp"

namespace broadside::tests {
namespace {

std::vector<core::FrameRecord> row_of_dominoes(const std::string& name, std::uint32_t steps) {
  auto scene = datasets::make_scene(name, {});
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().line());
  PipelineRig rig;
  rig.scene = std::move(scene).value();
  return rig.run(steps);
}

// The vertical part of a body's own vertical axis: 1 as it stands, 0 as it lies.
float upright(core::Quat q) {
  return core::rotate(q, {0.0F, 1.0F, 0.0F}).y;
}

// Each comes to lie on the next one's foot: a domino of 1 m by 0.2 m in steps of 0.5 m leans by acos(0.2 / 0.5), 66
// degrees, and the last lies flat.
TEST(Dominoes, AllLieOnceTheFirstIsTipped) {
  const auto frames = row_of_dominoes("domino:domino:20[rigid=1,gap=0.3,speed_m_s=0,topple_m_s=2,restitution=0]", 300);
  for (const core::Quat q : frames.front().orientation) EXPECT_GT(upright(q), 0.99F);
  for (const core::Quat q : frames.back().orientation) EXPECT_LT(upright(q), 0.45F);
  EXPECT_LT(upright(frames.back().orientation.back()), 0.01F);
  for (const core::Vec3 v : frames.back().velocity) EXPECT_LT(core::length(v), 0.01F);
}

// Not by a push through the center, which each hands on to the next one.
TEST(Dominoes, StandWhereTheFirstIsPushedThroughItsCenter) {
  const auto frames = row_of_dominoes("domino:domino:20[rigid=1]", 120);
  for (std::size_t k = 0; k + 1 < frames.back().orientation.size(); ++k)
    EXPECT_GT(upright(frames.back().orientation[k]), 0.9F) << k;
}

}  // namespace
}  // namespace broadside::tests

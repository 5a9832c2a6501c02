// Cubes of a heap leave the bodies that they fell on, and are struck from above while the gap is still small.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "datasets/scenes.hpp"
#include "tests/reference/octree_cpu/rigid/pipeline_rig.hpp"

namespace broadside::tests {
namespace {

// Before, one pair of this heap was missing among the candidates of such a step, and ended 46 mm deep.
TEST(StruckAgain, BodiesDoNotEndInWhatTheyHaveJustLeft) {
  auto scene = datasets::make_scene("freefall:cube:300[rigid=1,seed=2]", {});
  ASSERT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().line());
  PipelineRig rig;
  rig.scene = std::move(scene).value();
  float deepest_m = 0.0F;
  for (const core::FrameRecord& frame : rig.run(36))
    for (const core::ContactPoint& p : frame.points) deepest_m = std::max(deepest_m, -p.gap_m);
  EXPECT_LT(deepest_m, 0.02F);
}

}  // namespace
}  // namespace broadside::tests

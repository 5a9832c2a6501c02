#include "bench/cell/step_suffix.hpp"

#include <gtest/gtest.h>

#include "bench/cell/scene_arguments.hpp"

namespace broadside::bench {
namespace {

TEST(StepSuffix, IsANumberOrAFraction) {
  EXPECT_EQ(split_step("two-body:head-on@0.25").first, "two-body:head-on");
  EXPECT_EQ(*split_step("two-body:head-on@0.25").second, 0.25);
  EXPECT_EQ(*split_step("two-body:head-on@1/240").second, 1.0 / 240.0);
}

TEST(StepSuffix, AFileNameMayHaveAnAt) {
  for (const char* name : {"me@home.toml", "scene@", "scene@1/", "scene@/4", "scene@1/2/3", "plain"}) {
    EXPECT_EQ(split_step(name).first, name);
    EXPECT_FALSE(split_step(name).second) << name;
  }
}

// The scene lasts as long as before, in steps of another length.
TEST(StepSuffix, KeepsTheDuration) {
  SceneArguments plain{"two-body:head-on", 0, false};
  const auto scene = plain.make();
  ASSERT_TRUE(scene) << scene.error().line();
  const double duration = scene.value().frames * static_cast<double>(scene.value().dt_s);
  SceneArguments finer{"two-body:head-on@1/960", 0, false};
  const auto other = finer.make();
  ASSERT_TRUE(other) << other.error().line();
  EXPECT_EQ(other.value().dt_s, static_cast<float>(1.0 / 960.0));
  EXPECT_NEAR(other.value().frames / 960.0, duration, 0.5 / 960.0);
  EXPECT_EQ(other.value().name, "two-body:head-on@1/960");
}

TEST(StepSuffix, FramesThatAreGivenCount) {
  SceneArguments given{"two-body:head-on@1/960", 7, false};
  const auto scene = given.make();
  ASSERT_TRUE(scene) << scene.error().line();
  EXPECT_EQ(scene.value().frames, 7U);
}

TEST(StepSuffix, RefusesWhatIsNoStep) {
  for (const char* spec :
       {"two-body:head-on@0", "two-body:head-on@-1", "two-body:head-on@1/0", "two-body:head-on@1e-12"}) {
    const auto scene = SceneArguments{spec, 0, false}.make();
    ASSERT_FALSE(scene) << spec;
    EXPECT_EQ(scene.error().exit, core::Exit::kBadInput);
    EXPECT_NE(scene.error().line().find("the step after @"), std::string::npos) << scene.error().line();
  }
}

}  // namespace
}  // namespace broadside::bench

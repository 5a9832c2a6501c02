// Frames that are launched before the host has seen the frame before them equal the frames computed one by one, with a
// real queue.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>

#include "gpu/engines_on_cuda.hpp"
#include "gpu/frame/pipeline.hpp"
#include "tests/gpu/ahead_comparison.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

class FramesAhead : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = gpu_absent(); !why.empty()) GTEST_SKIP() << "not run: " << why;
  }
};

core::Scene spheres(std::uint32_t bodies, float cube_m, std::uint32_t static_every = 0) {
  return thrown_spheres(12, 25, bodies, cube_m, static_every);
}

TEST_F(FramesAhead, ThousandsOfThem) {
  expect_same_steps(spheres(60, 4.0F), {}, 3000);
  core::Scene pulled = spheres(40, 3.0F, 5);
  add_springs(pulled, 30);
  expect_same_steps(pulled, {}, 3000);
}

TEST_F(FramesAhead, EveryStartAndSolver) {
  expect_same_steps_of_every_start(spheres(100, 5.0F), 200);
}

// Numbers of bodies around those at which a larger kernel is chosen, and more bodies than threads.
TEST_F(FramesAhead, OfEveryKernel) {
  for (const std::uint32_t bodies : {1U, 512U, 600U, 5000U}) {
    SCOPED_TRACE(bodies);
    expect_same_steps(spheres(bodies, 0.9F * std::cbrt(static_cast<float>(bodies))), {}, 100);
  }
  SceneShape shape;
  shape.bodies = 300000;
  shape.cube_m = 40.0F;
  expect_same_steps(thrown({box_mesh({0.2F, 0.2F, 0.2F})}, shape), boxes_alone(), 8);
}

void expect_growth(std::uint32_t bodies) {
  SCOPED_TRACE(bodies);
  EXPECT_GT(expect_same_steps(flying_together(bodies, 6.0F), boxes_alone(), 16), 0U);
  PipelineOptions hashed = boxes_alone();
  hashed.broad = Broad::kHash;
  EXPECT_GT(expect_same_steps(flying_together(bodies, 6.0F), hashed, 16), 0U);
}

TEST_F(FramesAhead, BuffersGrowInTheMiddle) {
  expect_growth(110);
  EXPECT_GT(expect_same_steps(flying_out(400, 6.0F), boxes_alone(), 16), 0U);
}

TEST_F(FramesAhead, BuffersOfMeasuredPairsGrowInTheMiddle) {
  for (const core::Levels levels : {core::Levels::kFlat, core::Levels::kC}) {
    PipelineOptions options;
    options.levels = levels;
    EXPECT_GT(expect_same_steps(flying_together(110, 6.0F), options, 16), 0U);
  }
}

TEST_F(FramesAhead, BuffersOfMoreBodiesGrowInTheMiddle) {
  expect_growth(700);
  expect_growth(2500);
}

// Each time a frame is aborted, the host races with the frames that it has launched already.
TEST_F(FramesAhead, BuffersGrowAgainAndAgain) {
  const core::Scene scene = flying_together(250, 10.0F);
  for (int k = 0; k < 200; ++k) EXPECT_GT(expect_same_steps(scene, boxes_alone(), 14), 0U) << "run " << k;
}

TEST_F(FramesAhead, EndWhereTheyAreToldTo) {
  const core::Scene scene = spheres(60, 4.0F);
  for (std::uint64_t told = 1; told < 40; ++told) {
    Pipeline subject(PipelineOptions{});
    Pipeline one_by_one(PipelineOptions{});
    ASSERT_TRUE(subject.load(scene).ok() && one_by_one.load(scene).ok());
    std::uint64_t calls = 0;
    ASSERT_TRUE(subject.run(scene.dt_s, 100, [&] { return ++calls < told; }).ok());
    core::FrameRecord frame;
    ASSERT_TRUE(subject.read_back(frame, core::RecordLevel::kDigest).ok());
    EXPECT_GE(frame.step, told);
    step_by_step(one_by_one, scene.dt_s, frame.step);
    expect_same_frame(subject, one_by_one);
  }
}

// Two pipelines at once, with few bodies: the blocks of each wait for all blocks of that pipeline, and must not wait
// for room that the other one holds.
TEST_F(FramesAhead, OfTwoPipelinesAtOnce) {
  const core::Scene scene = spheres(60, 4.0F);
  constexpr std::uint64_t kFrames = 3000;
  Pipeline subjects[2] = {Pipeline(PipelineOptions{}), Pipeline(PipelineOptions{})};
  bool are_done[2] = {false, false};
  const auto run = [&](int k) {
    const auto goes_on = [] { return true; };
    are_done[k] = subjects[k].load(scene).ok() && subjects[k].run(scene.dt_s, kFrames, goes_on).ok();
  };
  std::thread other(run, 1);
  run(0);
  other.join();
  Pipeline one_by_one(PipelineOptions{});
  ASSERT_TRUE(one_by_one.load(scene).ok());
  step_by_step(one_by_one, scene.dt_s, kFrames);
  for (int k = 0; k < 2; ++k) {
    ASSERT_TRUE(are_done[k]) << k;
    expect_same_frame(subjects[k], one_by_one);
  }
}

}  // namespace
}  // namespace broadside::gpu

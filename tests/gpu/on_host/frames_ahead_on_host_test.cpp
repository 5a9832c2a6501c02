// Frames that are launched before the host has seen the frame before them. Here a launch returns when it is done, so a
// frame behind an aborted one always runs before the host learns of the abort. tests/gpu does the same with a real
// queue.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string_view>
#include <vector>

#include "gpu/frame/frame_queue.hpp"
#include "gpu/frame/pipeline.hpp"
#include "tests/gpu/ahead_comparison.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

const auto kGoOn = [] { return true; };

TEST(FramesAheadOnHost, AreTheFramesOneByOne) {
  for (const std::uint64_t steps : {0U, 1U, 2U, 3U, 12U}) {
    SCOPED_TRACE(steps);
    expect_same_steps(coarse_spheres(40, 2.5F), {}, steps);
  }
  for (const std::uint32_t bodies : {0U, 1U}) {
    SCOPED_TRACE(bodies);
    expect_same_steps(coarse_spheres(bodies, 2.5F), {}, 4);
  }
}

TEST(FramesAheadOnHost, SpringsAndStaticBodies) {
  core::Scene scene = coarse_spheres(40, 2.5F, 5);
  add_springs(scene, 30);
  expect_same_steps(scene, {}, 7);
}

TEST(FramesAheadOnHost, EveryStartAndSolver) {
  expect_same_steps_of_every_start(coarse_spheres(30, 2.2F), 4);
}

TEST(FramesAheadOnHost, MoreBodiesThanThreads) {
  SceneShape shape;
  shape.bodies = 300;
  shape.cube_m = 4.0F;
  PipelineOptions options = boxes_alone();
  options.least_for_grid = 100;
  expect_same_steps(thrown({box_mesh({0.5F, 0.5F, 0.5F}), box_mesh({0.02F, 0.03F, 0.02F})}, shape), options, 4);
}

// There are more pairs, and later more contacts with faces, than there is room for, while the next frame is launched
// already. That frame does nothing, and the aborted one is repeated from the state that the next frame would have
// overwritten.
TEST(FramesAheadOnHost, BuffersGrowInTheMiddle) {
  const core::Scene together = flying_together(110, 5.0F);
  EXPECT_GT(expect_same_steps(together, boxes_alone(), 9), 0U);
  PipelineOptions hashed = boxes_alone();
  hashed.broad = Broad::kHash;
  EXPECT_GT(expect_same_steps(together, hashed, 7), 0U);
  EXPECT_GT(expect_same_steps(flying_out(400, 3.5F), boxes_alone(), 7), 0U);

  Pipeline subject(boxes_alone());
  ASSERT_TRUE(subject.load(together).ok());
  const std::vector<StepSeen> seen = run_ahead(subject, together.dt_s, 9);
  EXPECT_LT(seen.front().pairs, 100U) << "it begins with room enough";
  EXPECT_EQ(subject.counters()[0].count, 9 + subject.repeated_frames()) << "frames that did nothing do not count";
}

// When the run is told to end, one step more may be under way. Afterwards the pipeline goes on from its last step, one
// by one or ahead, and says which step that is.
TEST(FramesAheadOnHost, EndWhereTheyAreToldTo) {
  const core::Scene scene = coarse_spheres(40, 2.5F);
  for (const std::uint64_t told : {1U, 3U, 9U, 10U}) {
    SCOPED_TRACE(told);
    Pipeline subject(PipelineOptions{});
    Pipeline one_by_one(PipelineOptions{});
    ASSERT_TRUE(subject.load(scene).ok());
    ASSERT_TRUE(one_by_one.load(scene).ok());
    std::uint64_t calls = 0;
    ASSERT_TRUE(subject.run(scene.dt_s, 10, [&] { return ++calls < told; }).ok());
    EXPECT_EQ(calls, told);
    core::FrameRecord frame;
    ASSERT_TRUE(subject.read_back(frame, core::RecordLevel::kDigest).ok());
    EXPECT_GE(frame.step, told);
    EXPECT_LT(frame.step, std::min<std::uint64_t>(told + FrameQueue::kMost, 11));
    step_by_step(one_by_one, scene.dt_s, frame.step);
    expect_same_frame(subject, one_by_one);
    EXPECT_EQ(run_ahead(subject, scene.dt_s, 2), step_by_step(one_by_one, scene.dt_s, 2));
    EXPECT_EQ(step_by_step(subject, scene.dt_s, 1), step_by_step(one_by_one, scene.dt_s, 1));
    expect_same_frame(subject, one_by_one);
  }
}

// The run is told to end at a frame while a later one is under way, and that later one is aborted: it is repeated all
// the same.
TEST(FramesAheadOnHost, EndBeforeAnAbortedFrame) {
  const core::Scene scene = flying_together(110, 5.0F);
  Pipeline one_by_one(boxes_alone());
  ASSERT_TRUE(one_by_one.load(scene).ok());
  std::uint64_t first_repeated = 0;
  while (one_by_one.repeated_frames() == 0) {
    step_by_step(one_by_one, scene.dt_s, 1);
    ASSERT_LT(++first_repeated, 9U);
  }
  Pipeline subject(boxes_alone());
  ASSERT_TRUE(subject.load(scene).ok());
  std::uint64_t calls = 0;
  ASSERT_TRUE(subject.run(scene.dt_s, 9, [&] { return ++calls + 1 < first_repeated; }).ok());
  EXPECT_EQ(calls, first_repeated - 1);
  EXPECT_EQ(subject.repeated_frames(), 1U);
  expect_same_frame(subject, one_by_one);
}

TEST(FramesAheadOnHost, BesideThoseOfAnotherPipeline) {
  const core::Scene first = coarse_spheres(40, 2.5F);
  const core::Scene second = flying_together(110, 3.0F);
  Pipeline a(PipelineOptions{});
  Pipeline b(boxes_alone());
  Pipeline b_alone(boxes_alone());
  Pipeline a_alone(PipelineOptions{});
  ASSERT_TRUE(a.load(first).ok() && a_alone.load(first).ok());
  ASSERT_TRUE(b.load(second).ok() && b_alone.load(second).ok());
  ASSERT_TRUE(a.run(first.dt_s, 4, [&] { return b.run(second.dt_s, 2, kGoOn).ok(); }).ok());
  step_by_step(a_alone, first.dt_s, 4);
  step_by_step(b_alone, second.dt_s, 8);
  expect_same_frame(a, a_alone);
  expect_same_frame(b, b_alone);
  EXPECT_GT(b.repeated_frames(), 0U);
}

// A digest that was not fetched is not mistaken for that of a later frame; and a digest asked for at the earlier
// interval is computed anew.
TEST(FramesAheadOnHost, DigestsAskedForAround) {
  const core::Scene scene = coarse_spheres(40, 2.5F);
  Pipeline subject(PipelineOptions{});
  Pipeline one_by_one(PipelineOptions{});
  ASSERT_TRUE(subject.load(scene).ok());
  ASSERT_TRUE(one_by_one.load(scene).ok());
  const auto digest_of = [](Pipeline& pipeline) {
    core::FrameRecord frame;
    EXPECT_TRUE(pipeline.read_back(frame, core::RecordLevel::kDigest).ok());
    return frame.digest;
  };
  for (const std::uint64_t steps : {1U, 1U, 2U, 3U, 0U, 4U}) {
    ASSERT_TRUE(subject.step(scene.dt_s).ok());
    ASSERT_TRUE(subject.start_copy(core::RecordLevel::kFull).ok());
    ASSERT_TRUE(subject.run(scene.dt_s, steps, kGoOn).ok());
    core::FrameRecord copied;
    ASSERT_TRUE(subject.finish_copy(copied).ok());
    step_by_step(one_by_one, scene.dt_s, 1);
    EXPECT_EQ(copied.digest, digest_of(one_by_one));
    step_by_step(one_by_one, scene.dt_s, steps);
    EXPECT_EQ(digest_of(subject), digest_of(one_by_one));
  }
}

TEST(FramesAheadOnHost, WorkIsCountedWhereItIsAskedFor) {
  const core::Scene scene = coarse_spheres(40, 2.5F);
  std::map<std::string_view, std::uint64_t> counts[2];
  for (const bool is_ahead : {false, true}) {
    PipelineOptions options;
    options.least_for_grid = 10;
    Pipeline subject(options);
    subject.count_work();
    ASSERT_TRUE(subject.load(scene).ok());
    std::uint64_t calls = 0;
    if (is_ahead)
      ASSERT_TRUE(subject.run(scene.dt_s, 6, [&] { return ++calls < 3; }).ok());
    else
      step_by_step(subject, scene.dt_s, 3);
    for (const core::Counter& counter : subject.counters()) counts[is_ahead ? 1 : 0][counter.name] = counter.count;
  }
  EXPECT_GT(counts[0].at("broad: box tests"), 0U);
  EXPECT_EQ(counts[0], counts[1]);
}

// Threads may come in any order.
TEST(FramesAheadOnHost, AnyOrderOfThreads) {
  for (const char* seed : {"1", "2", "3"}) {
    ASSERT_EQ(setenv("BROADSIDE_ON_HOST_SEED", seed, 1), 0);
    EXPECT_GT(expect_same_steps(flying_together(70, 3.0F), boxes_alone(), 5), 0U);
  }
  unsetenv("BROADSIDE_ON_HOST_SEED");
}

}  // namespace
}  // namespace broadside::gpu

// The GPU's pipeline of bodies that turn, with the kernels' threads on the host: its frames are octree-cpu's, bit for
// bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>

#include "core/engine/engine.hpp"
#include "core/method/rigid/step_in_parts.hpp"
#include "datasets/scenes.hpp"
#include "gpu/rigid/rigid_pipeline.hpp"
#include "tests/core/engine/counts.hpp"
#include "tests/gpu/octree_cpu_twin.hpp"
#include "tests/gpu/twin_comparison.hpp"
#include "tests/reference/octree_cpu/rigid/boulders.hpp"

namespace broadside::gpu {
namespace {

// Where a mesh is not on this machine, a body of its size class takes its place.
core::Scene scene_of(const std::string& name) {
  datasets::SceneOptions options;
  options.meshes.allow_procedural = true;
  auto scene = datasets::make_scene(name, options);
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().line());
  return std::move(scene).value();
}

std::uint64_t compare(const core::Scene& scene, int frames, const RigidPipelineOptions& options, const Given& given) {
  RigidPipeline subject(options);
  return compare_pipelines(scene, subject, *twin_of(given), frames, 3);
}

std::uint64_t compare(const std::string& name, int frames, const RigidPipelineOptions& options = {},
                      const Given& given = {}) {
  SCOPED_TRACE(name);
  return compare(scene_of(name), frames, options, given);
}

TEST(RigidOnHost, FreeMotionTurnsWithTheSameBits) {
  compare("rigid:torque-free:box", 20);
}

TEST(RigidOnHost, PrimitivesThatTouch) {
  EXPECT_GT(compare("rigid:stack:5", 20), 0U);
  EXPECT_GT(compare("rigid:sphere:slip-to-roll", 20), 0U);
  EXPECT_GT(compare("rigid:card-tent:stands", 12), 0U);
  EXPECT_GT(compare("rigid:billiards:three", 40), 0U);
}

TEST(RigidOnHost, CapsulesCylindersAndStones) {
  for (const char* shape : {"capsule", "cylinder", "stone"}) {
    EXPECT_GT(compare("freefall:" + std::string(shape) + ":12[rigid=1]", 50), 0U);
    EXPECT_GT(compare("randommove:" + std::string(shape) + ":12[rigid=1]", 30), 0U);
  }
}

// The pairs of these hulls are spread over all warps.
TEST(RigidOnHost, HullsThatTouch) {
  EXPECT_GT(compare("rigid:arch:7-stands", 8), 0U);
}

// Finely cut hulls: lanes dismiss pairs by bounds before warps make patches.
TEST(RigidOnHost, RoundHullsThatFall) {
  EXPECT_GT(compare(tests::five_boulders(), 30, {}, {}), 0U);
}

// Once they are slow their patches are carried from step to step.
TEST(RigidOnHost, RoundHullsThatRest) {
  const core::Scene scene = tests::five_boulders_in_a_shaft();
  RigidPipeline subject{{}};
  const auto twin = twin_of({});
  compare_pipelines(scene, subject, *twin, 150, 50);
  EXPECT_GT(tests::counts_of(*twin)["contact patches carried"], 50U);
}

TEST(RigidOnHost, AHeap) {
  EXPECT_GT(compare("freefall:cube:40[rigid=1]", 50), 0U);
}

// The threads of the solver are one cluster of blocks, or a grid.
TEST(RigidOnHost, AHeapSolvedByAGrid) {
  RigidPipelineOptions options;
  options.may_cluster = false;
  EXPECT_GT(compare("freefall:cube:20[rigid=1]", 40, options), 0U);
}

// As in the largest scenes.
TEST(RigidOnHost, AHeapWhoseConstraintsLieInPairsOfWords) {
  RigidPipelineOptions options;
  options.may_cluster = false;
  options.least_for_pairs = 0;
  EXPECT_GT(compare("freefall:cube:20[rigid=1]", 40, options), 0U);
  options.solver = core::soft_step_settings();
  EXPECT_GT(compare("freefall:cube:20[rigid=1]", 40, options, {{"contact", "soft-step"}}), 0U);
}

// The first color has some three patches a thread: warps choose which of them a sweep visits while cubes land and
// bounce.
TEST(RigidOnHost, ALargeColor) {
  RigidPipelineOptions soft_steps;
  soft_steps.solver = core::soft_step_settings();
  EXPECT_GT(compare("freefall:cube:250[rigid=1]", 42, soft_steps, {{"contact", "soft-step"}}), 0U);
  EXPECT_GT(compare("freefall:cube:250[rigid=1]", 42), 0U);
  // Cubes that begin in each other: nearly all of a color is visited.
  core::Scene scene = scene_of("freefall:cube:600[rigid=1]");
  for (core::Body& body : scene.bodies) body.position = 0.5F * body.position;
  EXPECT_GT(compare(scene, 4, {}, {}), 0U);
}

// Masses that differ much: a step is taken in parts, and the points of the parts are put together. The heavy body comes
// down askew.
TEST(RigidOnHost, AStepInParts) {
  core::Scene scene = scene_of("rigid:stack:1000-on-1");
  EXPECT_GT(core::most_parts({}, core::largest_mass_ratio(scene), false), 1U);
  core::Body& heavy = *std::ranges::min_element(
      scene.bodies, {}, [](const core::Body& b) { return b.inverse_mass > 0.0F ? b.inverse_mass : 1e9F; });
  heavy.velocity = {1.0F, -3.0F, 0.5F};
  heavy.angular_velocity = {1.0F, 2.0F, 3.0F};
  EXPECT_GT(compare(scene, 4, {}, {}), 0U);
  // At rest a step is taken in one part.
  EXPECT_GT(compare("rigid:stack:1000-on-1", 3), 0U);
}

// In step 142, sweeps over the remaining pushes are the first to give an impulse to a point that approached fast.
TEST(RigidOnHost, WhatCameFastIsMetWhilePushesAreSwept) {
  EXPECT_GT(compare("freefall:brick:200[rigid=1]", 142), 0U);
}

// Thin bodies come down. A step is begun with the plan of the step before; where that is not the right plan, the step
// is begun again. Also with bodies that sleep.
TEST(RigidOnHost, StepsInPartsByHowFarBodiesMove) {
  core::Scene scene = scene_of("domino:domino:3[rigid=1]");
  for (core::Body& body : scene.bodies)
    if (body.inverse_mass > 0.0F) body.velocity = {};
  core::Body& last = scene.bodies.back();
  last.position.y += 0.7F;
  scene.domain.max.y += 2.0F;
  for (const bool sleeps : {false, true}) {
    SCOPED_TRACE(sleeps);
    RigidPipelineOptions options;
    options.sleeps = sleeps;
    RigidPipeline subject(options);
    const auto twin = twin_of(sleeps ? Given{{"sleep", "on"}} : Given{});
    ASSERT_TRUE(subject.load(scene).ok() && twin->load(scene).ok());
    std::map<std::uint32_t, int> steps_in;
    for (int step = 0; step < 60; ++step) {
      ASSERT_TRUE(subject.step(scene.dt_s).ok() && twin->step(scene.dt_s).ok());
      core::FrameRecord of_gpu;
      core::FrameRecord of_twin;
      ASSERT_TRUE(subject.read_back(of_gpu, core::RecordLevel::kFull).ok());
      ASSERT_TRUE(twin->read_back(of_twin, core::RecordLevel::kFull).ok());
      ASSERT_EQ(of_gpu.digest, of_twin.digest) << "step " << step;
      ASSERT_EQ(of_gpu.parts, of_twin.parts) << "step " << step;
      ++steps_in[of_gpu.parts];
    }
    EXPECT_EQ(steps_in.size(), 3U) << "one, two and four";
  }
}

// One sweep a substep is another path through the kernel than conjugate directions.
TEST(RigidOnHost, SoftSteps) {
  RigidPipelineOptions options;
  options.solver = core::soft_step_settings();
  EXPECT_GT(compare("freefall:cube:20[rigid=1]", 45, options, {{"contact", "soft-step"}}), 0U);
}

// Cubes that begin deep in each other are pushed apart, and the velocity of the push is taken back; with other heaps
// around them, with bounces, and without gravity.
TEST(RigidOnHost, WhatPushesIsTakenBack) {
  for (const char* name : {"rigid:stack:5", "freefall:cube:20[rigid=1]"}) {
    SCOPED_TRACE(name);
    core::Scene scene = scene_of(name);
    for (core::Body& body : scene.bodies) body.position.y *= 0.9F;
    RigidPipelineOptions soft_steps;
    soft_steps.solver = core::soft_step_settings();
    EXPECT_GT(compare(scene, 30, {}, {}), 0U);
    EXPECT_GT(compare(scene, 30, soft_steps, {{"contact", "soft-step"}}), 0U);
    scene.gravity_m_s2 = {};
    EXPECT_GT(compare(scene, 12, {}, {}), 0U);
  }
}

// An edge that comes down within a step is solved by relaxation alone; sweeps continue from there.
TEST(RigidOnHost, EdgesThatStrikeWithoutGravity) {
  for (const float dt_s : {1.0F / 60.0F, 1.0F / 120.0F}) {
    SCOPED_TRACE(dt_s);
    core::Scene scene = scene_of("rigid:needle-through-plate");
    scene.dt_s = dt_s;
    RigidPipeline subject(RigidPipelineOptions{});
    EXPECT_GT(compare_pipelines(scene, subject, *twin_of({}), 14, 1), 0U);
  }
}

// A contact that bounces stirs its neighbors; wrenches are added in each substep.
TEST(RigidOnHost, BouncesAndWrenches) {
  EXPECT_GT(compare("rigid:billiards:cradle", 60), 0U);
  compare("rigid:flight:pushed", 10);
}

// Two piles sleep, and one wakes when the last body comes down on it. Digests are equal in every frame; they include
// the impulses that contacts of sleeping bodies go on giving.
TEST(RigidOnHost, PilesSleepAndWake) {
  core::Scene scene = scene_of("rigid:stack:5");
  ASSERT_EQ(scene.bodies.size(), 5U);
  const float side = scene.bodies[1].position.y - scene.bodies[0].position.y;
  scene.bodies[2].position.x += 3.0F * side;
  scene.bodies[2].position.y = scene.bodies[0].position.y;
  scene.bodies[3].position = scene.bodies[2].position;
  scene.bodies[3].position.y += side;
  scene.bodies[4].position.y = scene.bodies[1].position.y + 8.0F * side;
  scene.domain.max.y += 8.0F * side;
  scene.dt_s = 1.0F / 60.0F;
  RigidPipelineOptions options;
  options.sleeps = true;
  RigidPipeline subject(options);
  const auto twin = twin_of({{"sleep", "on"}});
  EXPECT_GT(compare_pipelines(scene, subject, *twin, 110, 10), 0U);
  auto of_gpu = tests::counts_of(subject);
  auto of_twin = tests::counts_of(*twin);
  EXPECT_GT(of_gpu["sleep: bodies asleep"], 100U);
  EXPECT_EQ(of_gpu["sleep: bodies asleep"], of_twin["sleep: bodies asleep"]);
  core::FrameRecord last;
  ASSERT_TRUE(subject.read_back(last, core::RecordLevel::kFull).ok());
  EXPECT_NE(last.velocity[0], core::Vec3{}) << "the struck pile is awake";
  EXPECT_EQ(last.velocity[3], core::Vec3{}) << "the other one sleeps";
}

// Bodies fly at each other, through thin ones and at the floor, and move farther in a step than they are thick: they
// stop on the way, at the same places as in the twin.
TEST(RigidOnHost, FastBodiesStopShort) {
  std::uint64_t stopped = 0;
  RigidPipelineOptions options;
  options.swept = core::Swept::kAll;
  for (const char* name : {"rigid:bullet-through-cards", "rigid:needle-through-plate", "freefall:cube:20[rigid=1]",
                           "freefall:bunny:3[rigid=1]"}) {
    SCOPED_TRACE(name);
    core::Scene scene = scene_of(name);
    if (scene.bodies.size() == 20U)
      for (core::Body& body : scene.bodies) body.velocity = {0.0F, body.position.y > 3.0F ? -100.0F : 40.0F, 0.0F};
    RigidPipeline subject(options);
    const auto twin = twin_of({{"sweep", "fast"}});
    compare_pipelines(scene, subject, *twin, 12, 3);
    auto of_gpu = tests::counts_of(subject);
    auto of_twin = tests::counts_of(*twin);
    EXPECT_EQ(of_gpu["sweep: bodies stopped short"], of_twin["sweep: bodies stopped short"]);
    stopped += of_gpu["sweep: bodies stopped short"];
  }
  EXPECT_GT(stopped, 10U);
}

// Where the scene flags its bullet alone, only pairs of that bullet are swept.
TEST(RigidOnHost, FlaggedBodiesStopShort) {
  core::Scene scene = scene_of("rigid:bullet-through-cards");
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) scene.is_fast[i] = 0;
  RigidPipeline subject{{}};
  const auto twin = twin_of({});
  compare_pipelines(scene, subject, *twin, 12, 3);
  EXPECT_EQ(tests::counts_of(subject)["sweep: bodies stopped short"],
            tests::counts_of(*twin)["sweep: bodies stopped short"]);
  EXPECT_GT(tests::counts_of(*twin)["sweep: bodies stopped short"], 0U);
}

// The GPU and the twin count the same number of sweeps.
TEST(RigidOnHost, SweepsAreCountedAlike) {
  const core::Scene scene = scene_of("freefall:cube:12[rigid=1]");
  RigidPipeline subject{{}};
  const auto twin = twin_of({});
  ASSERT_TRUE(subject.load(scene).ok() && twin->load(scene).ok());
  for (int k = 0; k < 35; ++k) ASSERT_TRUE(subject.step(scene.dt_s).ok() && twin->step(scene.dt_s).ok());
  auto of_gpu = tests::counts_of(subject);
  auto of_twin = tests::counts_of(*twin);
  EXPECT_GT(of_gpu["solver: sweeps of bounces"], 0U);
  for (const char* name : {"solver: sweeps", "solver: sweeps of bounces"})
    EXPECT_EQ(of_gpu[name], of_twin[name]) << name;
  EXPECT_GT(of_gpu["solver: waits"], of_gpu["solver: sweeps"]);
}

// All threads wait at a barrier once, at the end of the step: soft steps in which nothing bounces have no other
// barrier.
TEST(RigidOnHost, SoftStepsWaitForVersionsAlone) {
  core::Scene scene = scene_of("rigid:stack:5");
  RigidPipelineOptions options;
  options.solver = core::soft_step_settings();
  RigidPipeline subject(options);
  ASSERT_TRUE(subject.load(scene).ok());
  constexpr std::uint64_t kSteps = 10;
  for (std::uint64_t k = 0; k < kSteps; ++k) ASSERT_TRUE(subject.step(scene.dt_s).ok());
  auto counts = tests::counts_of(subject);
  EXPECT_GT(counts["solver: sweeps"], kSteps);
  EXPECT_EQ(counts["solver: sweeps of bounces"], 0U);
  EXPECT_EQ(counts["solver: waits"], kSteps);
}

TEST(RigidOnHost, EveryStartAndLevel) {
  for (const core::LevelsRow& row : core::kLevels) {
    SCOPED_TRACE(row.name);
    RigidPipelineOptions options;
    options.levels = row.levels;
    const std::string name(row.name);
    EXPECT_GT(compare("freefall:cube:12[rigid=1]", 30, options, {{"levels", name}}), 0U);
    options.broad = Broad::kBrute;
    EXPECT_GT(compare("freefall:cube:12[rigid=1]", 30, options, {{"broad", "brute"}, {"levels", name}}), 0U);
  }
  RigidPipelineOptions options;
  options.broad = Broad::kOctree;
  EXPECT_GT(compare("freefall:cube:12[rigid=1]", 30, options, {{"broad", "octree"}}), 0U);
  options.broad = Broad::kTree;
  options.least_for_grid = 2;
  EXPECT_GT(compare("freefall:cube:40[rigid=1]", 40, options), 0U);
}

// Once, a first frame that searched cells of size zero did not end where a box lies across a coordinate of 0; some of
// these boxes do.
TEST(RigidOnHost, TheFirstFrameSearchesNoCells) {
  RigidPipelineOptions options;
  options.least_for_grid = 2;
  compare("freefall:cube:250[rigid=1]", 3, options);
}

// The threads of the kernel run in another order each round.
TEST(RigidOnHost, NoOrderOfThreadsShows) {
  for (const char* seed : {"1", "2", "3"}) {
    SCOPED_TRACE(seed);
    ASSERT_EQ(setenv("BROADSIDE_ON_HOST_SEED", seed, 1), 0);
    EXPECT_GT(compare("freefall:cube:20[rigid=1]", 30), 0U);
    unsetenv("BROADSIDE_ON_HOST_SEED");
  }
}

}  // namespace
}  // namespace broadside::gpu

// The GPU's pipeline of bodies that turn, with the kernels' threads on the host: its frames are octree-cpu's, bit for
// bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/engine/engine.hpp"
#include "core/method/rigid/step_in_parts.hpp"
#include "datasets/scenes.hpp"
#include "gpu/rigid/rigid_pipeline.hpp"
#include "reference/engines.hpp"
#include "tests/gpu/twin_comparison.hpp"

namespace broadside::gpu {
namespace {

using Given = std::map<std::string, std::string>;

std::unique_ptr<core::Dynamics> twin_of(const Given& given) {
  const core::EngineRow row = reference::octree_cpu_row();
  auto settings = core::Settings::parse(row.id, row.settings, given);
  EXPECT_TRUE(settings.ok());
  return std::move(row.create(settings.value()).value().dynamics);
}

core::Scene scene_of(const std::string& name) {
  auto scene = datasets::make_scene(name, {});
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

// Their pairs are spread over all warps.
TEST(RigidOnHost, HullsThatTouch) {
  EXPECT_GT(compare("rigid:arch:7-stands", 8), 0U);
}

TEST(RigidOnHost, AHeap) {
  EXPECT_GT(compare("freefall:cube:40[rigid=1]", 50), 0U);
}

// The solver's threads: one cluster of blocks, or a grid.
TEST(RigidOnHost, AHeapSolvedByAGrid) {
  RigidPipelineOptions options;
  options.may_cluster = false;
  EXPECT_GT(compare("freefall:cube:20[rigid=1]", 40, options), 0U);
}

// Masses that are far apart: a step is taken in parts, and its points are put together. The heavy one comes down askew.
TEST(RigidOnHost, AStepInParts) {
  core::Scene scene = scene_of("rigid:stack:1000-on-1");
  EXPECT_GT(core::parts_of_step({}, core::largest_mass_ratio(scene)), 1U);
  core::Body& heavy = *std::ranges::min_element(
      scene.bodies, {}, [](const core::Body& b) { return b.inverse_mass > 0.0F ? b.inverse_mass : 1e9F; });
  heavy.velocity = {1.0F, -3.0F, 0.5F};
  heavy.angular_velocity = {1.0F, 2.0F, 3.0F};
  EXPECT_GT(compare(scene, 4, {}, {}), 0U);
}

// One sweep a substep is another path through the kernel than conjugate directions.
TEST(RigidOnHost, SoftSteps) {
  RigidPipelineOptions options;
  options.solver = core::soft_step_settings();
  EXPECT_GT(compare("freefall:cube:20[rigid=1]", 45, options, {{"contact", "soft-step"}}), 0U);
}

// Cubes that begin deep in each other are pushed apart, and what pushed them is taken back; with other heaps around
// them, with bounces, and without gravity.
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

// What bounces stirs its neighbors; wrenches are added in each substep.
TEST(RigidOnHost, BouncesAndWrenches) {
  EXPECT_GT(compare("rigid:billiards:cradle", 60), 0U);
  compare("rigid:flight:pushed", 10);
}

// Both say how many sweeps they took.
TEST(RigidOnHost, SweepsAreCountedAlike) {
  const core::Scene scene = scene_of("freefall:cube:12[rigid=1]");
  RigidPipeline subject{{}};
  const auto twin = twin_of({});
  ASSERT_TRUE(subject.load(scene).ok() && twin->load(scene).ok());
  for (int k = 0; k < 35; ++k) ASSERT_TRUE(subject.step(scene.dt_s).ok() && twin->step(scene.dt_s).ok());
  const auto counts_of = [](const core::Dynamics& dynamics) {
    std::map<std::string, std::uint64_t> counts;
    for (const core::Counter& counter : dynamics.counters()) counts[std::string(counter.name)] = counter.count;
    return counts;
  };
  auto of_gpu = counts_of(subject);
  auto of_twin = counts_of(*twin);
  EXPECT_GT(of_gpu["solver: sweeps of bounces"], 0U);
  for (const char* name : {"solver: sweeps", "solver: sweeps of bounces"})
    EXPECT_EQ(of_gpu[name], of_twin[name]) << name;
  EXPECT_GT(of_gpu["solver: waits"], of_gpu["solver: sweeps"]);
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

// A first frame that searched cells of no size did not end where a box lies across a coordinate of 0: some of these do.
TEST(RigidOnHost, TheFirstFrameSearchesNoCells) {
  RigidPipelineOptions options;
  options.least_for_grid = 2;
  compare("freefall:cube:250[rigid=1]", 3, options);
}

// Threads of the kernel in another order each round.
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

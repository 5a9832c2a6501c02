// The turning pipeline as a whole: same bits on any number of threads and at every level, free motion, what is refused.
#include "reference/octree_cpu/rigid/rigid_pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "datasets/scenes.hpp"
#include "reference/octree_cpu/rigid/rigid_declaration.hpp"
#include "reference/scene_octree/broad_phases.hpp"
#include "tests/reference/octree_cpu/rigid/boulders.hpp"

namespace broadside::tests {
namespace {

using core::FrameRecord;
using core::Levels;
using core::Scene;
using reference::RigidPipeline;
using reference::RigidPipelineOptions;

RigidPipelineOptions options(int threads = 0, Levels levels = Levels::kC) {
  RigidPipelineOptions o;
  o.make_broad_phase = [](const Scene&) { return reference::make_tree_broad_phase(); };
  o.levels = levels;
  o.make_solver = [](const Scene&) { return reference::make_contact_solver({}); };
  o.declare = [](const core::Scene& scene) { return reference::rigid_declaration({}, scene); };
  o.threads = threads;
  return o;
}

Scene scene_of(const std::string& name) {
  auto scene = datasets::make_scene(name, {});
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().line());
  return std::move(scene).value();
}

// All frames, at full.
std::vector<FrameRecord> frames_of(RigidPipelineOptions how, const Scene& scene, std::uint32_t steps) {
  RigidPipeline engine(std::move(how));
  const core::Status loaded = engine.load(scene);
  EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? "" : loaded.error().line());
  std::vector<FrameRecord> frames(steps);
  for (FrameRecord& frame : frames) {
    EXPECT_TRUE(engine.step(scene.dt_s).ok());
    EXPECT_TRUE(engine.read_back(frame, core::RecordLevel::kFull).ok());
  }
  return frames;
}

std::vector<std::uint64_t> digests(const std::vector<FrameRecord>& frames) {
  std::vector<std::uint64_t> all;
  for (const FrameRecord& f : frames) all.push_back(f.digest);
  return all;
}

// Cubes that fall on each other, of several sizes.
constexpr const char* kHeap = "mixed-sizes:cube:40[rigid=1]";

TEST(RigidPipeline, HasTheSameBitsOnAnyNumberOfThreads) {
  const Scene scene = scene_of(kHeap);
  const auto one = frames_of(options(1), scene, 120);
  std::size_t points = 0;
  for (const FrameRecord& f : one) points += f.points.size();
  ASSERT_GT(points, 1000U) << "the bodies did not touch";
  for (const int threads : {2, 3}) EXPECT_EQ(digests(frames_of(options(threads), scene, 120)), digests(one)) << threads;
}

// A box is one node at every level; the levels then differ in what they count and not in what they confirm.
TEST(RigidPipeline, HasTheSameBitsAtLevelsAToCAndWithoutABroadPhase) {
  const Scene scene = scene_of(kHeap);
  const auto c = digests(frames_of(options(), scene, 60));
  EXPECT_EQ(digests(frames_of(options(0, Levels::kA), scene, 60)), c);
  EXPECT_EQ(digests(frames_of(options(0, Levels::kB), scene, 60)), c);
  RigidPipelineOptions brute = options();
  brute.make_broad_phase = nullptr;
  EXPECT_EQ(digests(frames_of(std::move(brute), scene, 60)), c);
}

// A body that is struck moves on in the same step. Before, cubes that fell on each other ended 5 cm deep in those
// below.
TEST(RigidPipeline, AStruckBodyMeetsTheNextOne) {
  const Scene scene = scene_of("freefall:cube:100[rigid=1,frames=60]");
  float deepest = 0.0F;
  for (const FrameRecord& f : frames_of(options(), scene, 60))
    for (const core::ContactPoint& p : f.points) deepest = std::max(deepest, -p.gap_m);
  // The limit for class A without the part for speed: the scene's slop, and what two bodies fall in a step.
  const float fall_m = core::length(scene.gravity_m_s2) * scene.dt_s * scene.dt_s;
  EXPECT_LT(deepest, scene.parameters.delta_m + 2.0F * fall_m);
}

// Patches are not carried for bodies that fall, nor where some bodies may sleep.
TEST(RigidPipeline, CarriesPatchesOfRoundHullsThatRest) {
  const auto carried = [](bool sleeps, std::uint32_t steps) {
    RigidPipelineOptions how = options();
    how.sleeps = sleeps;
    RigidPipeline engine(std::move(how));
    const Scene scene = five_boulders_in_a_shaft();
    EXPECT_TRUE(engine.load(scene).ok());
    for (std::uint32_t k = 0; k < steps; ++k) EXPECT_TRUE(engine.step(scene.dt_s).ok());
    for (const core::Counter& c : engine.counters())
      if (c.name == "contact patches carried") return c.count;
    return ~std::uint64_t{0};
  };
  EXPECT_EQ(carried(false, 5), 0U);
  EXPECT_GT(carried(false, 120), 100U);
  EXPECT_EQ(carried(true, 120), 0U);
}

TEST(RigidPipeline, RepeatsARunAfterAnotherLoad) {
  const Scene scene = scene_of(kHeap);
  const Scene other = scene_of("rigid:stack:5");
  RigidPipeline engine(options());
  std::vector<std::uint64_t> first;
  for (const bool again : {false, true}) {
    ASSERT_TRUE(engine.load(other).ok());
    for (int k = 0; k < 10; ++k) ASSERT_TRUE(engine.step(other.dt_s).ok());
    ASSERT_TRUE(engine.load(scene).ok());
    std::vector<std::uint64_t> found;
    for (int k = 0; k < 60; ++k) {
      FrameRecord frame;
      ASSERT_TRUE(engine.step(scene.dt_s).ok());
      ASSERT_TRUE(engine.read_back(frame, core::RecordLevel::kDigest).ok());
      found.push_back(frame.digest);
    }
    if (again) {
      EXPECT_EQ(found, first);
    }
    first = found;
  }
}

TEST(RigidPipeline, DigestsTellPointsAndOrientationsApart) {
  const auto frames = frames_of(options(), scene_of("rigid:stack:5"), 2);
  ASSERT_FALSE(frames[0].points.empty());
  EXPECT_NE(frames[0].digest, frames[1].digest);
}

// Semi-implicit Euler: after n steps the center is at x0 + h v0 n + h^2 g n (n + 1) / 2, less what substeps of the
// method make of the last sum; the angular momentum is that of the start.
TEST(RigidPipeline, ABodyThatTouchesNothingFallsAndKeepsItsSpin) {
  const Scene scene = scene_of("rigid:torque-free:box");
  const auto frames = frames_of(options(), scene, 200);
  const auto momentum = [](const FrameRecord& f) {
    // 0.1 x 0.4 x 0.9 m, 10 kg.
    const core::Quat q = f.orientation[0];
    const core::Vec3 w = core::rotate({q.w, -q.x, -q.y, -q.z}, f.angular_velocity[0]);
    return core::rotate(q, {w.x * 10.0F / 12.0F * 0.97F, w.y * 10.0F / 12.0F * 0.82F, w.z * 10.0F / 12.0F * 0.17F});
  };
  const core::Vec3 first = momentum(frames.front());
  for (const FrameRecord& f : frames) {
    const core::Vec3 now = momentum(f);
    // What two turns of a float round.
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(now[k], first[k], 40 * 0x1p-24 * core::length(first));
    ASSERT_TRUE(f.points.empty());
  }
  EXPECT_GT(std::abs(frames.back().orientation[0].y - frames.front().orientation[0].y), 0.01F);
}

TEST(RigidPipeline, AWrenchActs) {
  Scene scene = scene_of("rigid:torque-free:box");
  scene.bodies[0].angular_velocity = {};
  scene.wrenches = {{0, core::WrenchAxes::kWorld, {5.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F}}};
  const auto frames = frames_of(options(), scene, 100);
  const float t = 100.0F * scene.dt_s;
  EXPECT_NEAR(frames.back().velocity[0].x, 5.0F / 10.0F * t, 1e-5F);
}

// An arch that stands with 1 % to spare, for half a second: how far a stone moves, m.
float moved_in_arch(const core::SoftSettings& solver) {
  const Scene scene = scene_of("rigid:arch:25-stands");
  RigidPipelineOptions how = options();
  how.make_solver = [&](const Scene&) { return reference::make_soft_solver(solver); };
  const auto frames = frames_of(how, scene, 120);
  float farthest = 0.0F;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    farthest = std::max(farthest, core::length(frames.back().position[i] - scene.bodies[i].position));
  return farthest;
}

TEST(RigidPipeline, AnArchThatStandsByLittleStands) {
  EXPECT_LT(moved_in_arch(core::stiff_settings()), 0.0005F);
  EXPECT_LT(moved_in_arch({}), 0.0005F);
  core::SoftSettings softer;
  softer.few = softer.even;
  EXPECT_GT(moved_in_arch(softer), 0.01F) << "it stands with softer contacts too";
}

TEST(RigidPipeline, RefusesSprings) {
  Scene scene = scene_of("rigid:stack:5");
  scene.springs.push_back({0, {}, 10.0F, 0.0F});
  RigidPipeline engine(options());
  const core::Status s = engine.load(scene);
  ASSERT_FALSE(s.ok());
  EXPECT_NE(s.error().what.find("springs"), std::string::npos);
}

TEST(RigidPipeline, ASpinThatNoStepCanFollowStaysFinite) {
  Scene scene = scene_of("rigid:torque-free:box");
  scene.bodies[0].angular_velocity = {1e6F, 2e6F, -3e6F};
  const auto frames = frames_of(options(), scene, 20);
  const core::Quat q = frames.back().orientation[0];
  EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0F, 1e-3F);
}

}  // namespace
}  // namespace broadside::tests

// The GPU's pipeline, stage by stage the code that CUDA compiles, with the kernels' threads on the host: its frames are
// octree-cpu's, bit for bit. Where there is a GPU, tests/gpu runs larger scenes on it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "gpu/frame/pipeline.hpp"
#include "tests/core/engine/counts.hpp"
#include "tests/gpu/octree_cpu_twin.hpp"
#include "tests/gpu/small_scenes.hpp"
#include "tests/gpu/twin_comparison.hpp"

namespace broadside::gpu {
namespace {

std::uint64_t compare(const core::Scene& scene, const PipelineOptions& options, const Given& given, int frames) {
  Pipeline subject(options);
  return compare_pipelines(scene, subject, *twin_of(given), frames, 3);
}

TEST(PipelineOnHost, EveryStart) {
  PipelineOptions options;
  EXPECT_GT(compare(coarse_spheres(40, 2.5F), options, {{"broad", "brute"}}, 12), 0U);
  options.broad = Broad::kHash;
  EXPECT_GT(compare(coarse_spheres(40, 2.5F), options, {{"broad", "brute"}}, 12), 0U);
  options.hash_cell_m = 0.03F;  // too many cells a body
  EXPECT_GT(compare(coarse_spheres(20, 2.0F), options, {{"broad", "brute"}}, 3), 0U);
  options.broad = Broad::kOctree;
  EXPECT_GT(compare(coarse_spheres(40, 2.5F), options, {{"broad", "octree"}}, 12), 0U);
}

TEST(PipelineOnHost, EveryLevelFromItsPublishedStart) {
  for (const core::LevelsRow& row : core::kLevels) {
    SCOPED_TRACE(row.name);
    PipelineOptions options;
    options.broad = Broad::kBrute;
    options.levels = row.levels;
    EXPECT_GT(compare(coarse_spheres(30, 2.2F), options, {{"broad", "brute"}, {"levels", std::string(row.name)}}, 4),
              0U);
  }
}

TEST(PipelineOnHost, EveryPrintedForm) {
  for (const std::string name : {"printed-E2", "printed-E3", "printed-E4", "printed-E5", "printed-E6", "printed-E7"}) {
    SCOPED_TRACE(name);
    PipelineOptions options;
    options.variant = *core::variant_named(name);
    EXPECT_GT(compare(coarse_spheres(40, 2.5F, 4), options, {{"variant", name}}, 10), 0U);
  }
}

TEST(PipelineOnHost, StaticBodiesAndTheJacobiSolver) {
  PipelineOptions options;
  EXPECT_GT(compare(coarse_spheres(40, 2.5F, 3), options, {}, 12), 0U);
  options.solver = Solver::kJacobi;
  EXPECT_GT(compare(coarse_spheres(40, 2.5F, 3), options, {{"solver", "jacobi"}}, 12), 0U);
}

// Nearest vertices are looked up in cells, or found by descending two trees: with cells for both shapes, for one, or
// for none. A pair gets one warp where the grid has no more warps than pairs, and several where it has more; several
// warps have less room than they might fill, and then open one pair of nodes at a time.
TEST(PipelineOnHost, NearestVerticesByCellsAndByTrees) {
  SceneShape shape;
  shape.bodies = 21;  // of two meshes, some turned: shapes of 7, 7, 4 and 3 bodies
  shape.cube_m = 1.9F;
  const core::Scene many = thrown({bumpy_sphere(8, 0.5F), bumpy_sphere(9, 0.6F)}, shape);
  shape.bodies = 2;
  shape.cube_m = 0.8F;
  const core::Scene few = thrown({bumpy_sphere(9, 0.6F)}, shape);
  for (const std::uint32_t least : {1U, 5U, 100U}) {
    SCOPED_TRACE(least);
    PipelineOptions options;
    options.least_for_cells = least;
    EXPECT_GT(compare(many, options, {}, 3), 0U);
    EXPECT_GT(compare(few, options, {}, 2), 0U);
  }
}

// Springs act on some bodies, several on one; a step that is too long for one of them is refused, as by the twin.
TEST(PipelineOnHost, Springs) {
  core::Scene scene = coarse_spheres(40, 2.5F);
  add_springs(scene, 30);
  EXPECT_GT(compare(scene, {}, {}, 12), 0U);
  core::Scene without = scene;
  without.springs.clear();
  Pipeline pulled(PipelineOptions{});
  Pipeline free(PipelineOptions{});
  ASSERT_TRUE(pulled.load(scene).ok());
  ASSERT_TRUE(free.load(without).ok());
  ASSERT_TRUE(pulled.step(scene.dt_s).ok());
  ASSERT_TRUE(free.step(scene.dt_s).ok());
  core::FrameRecord a;
  core::FrameRecord b;
  ASSERT_TRUE(pulled.read_back(a, core::RecordLevel::kDigest).ok());
  ASSERT_TRUE(free.read_back(b, core::RecordLevel::kDigest).ok());
  EXPECT_NE(a.digest, b.digest);

  scene.springs.push_back({3, {}, 1e6F, 0.0F});
  const core::Status refused = Pipeline(PipelineOptions{}).load(scene);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().line(), twin_of({})->load(scene).error().line());
}

// From two bodies on a ring to more bodies than there are warps, and up to the number at which tiles begin.
TEST(PipelineOnHost, FewBodiesOfEveryNumber) {
  for (const std::uint32_t bodies : {1U, 2U, 3U, 33U, 64U, 128U, 129U}) {
    SCOPED_TRACE(bodies);
    const core::Scene scene = coarse_spheres(bodies, 0.55F * std::cbrt(static_cast<float>(bodies)), 7);
    for (const std::string name : {"flat", "C"}) {
      PipelineOptions options;
      options.levels = *core::levels_named(name);
      compare(scene, options, {{"levels", name}}, 2);
    }
  }
}

// Levels are descended while pairs are measured, or where the pairs are found: for the first frame the pairs of the
// frame before are unknown.
TEST(PipelineOnHost, EveryLevelOfFewBodies) {
  const core::Scene scene = coarse_spheres(40, 1.6F, 5);
  for (const bool has_vertex_stage : {true, false}) {
    for (const std::string name : {"level1", "A", "B"}) {
      SCOPED_TRACE(name + (has_vertex_stage ? "" : " without vertices"));
      PipelineOptions options;
      options.levels = *core::levels_named(name);
      options.has_vertex_stage = has_vertex_stage;
      EXPECT_GT(compare(scene, options, {{"levels", name}, {"vertex_stage", has_vertex_stage ? "on" : "off"}}, 3), 0U);
    }
  }
}

// Two bodies that approach corner by corner: at first their boxes overlap and nothing inside them does. One block
// measures the pair, by cells or by trees, while another one descends its levels.
TEST(PipelineOnHost, LevelsOfAPairThatIsMeasuredMeanwhile) {
  SceneShape shape;
  shape.bodies = 2;
  shape.gravity_m_s2 = 0.0F;
  core::Scene scene = thrown({bumpy_sphere(9, 0.6F)}, shape);
  for (core::Body& body : scene.bodies) body.velocity = {};
  scene.bodies[1].position = scene.bodies[0].position + core::Vec3{1.1F, 1.1F, 0.05F};
  const float step_m = 0.02F;
  scene.bodies[1].velocity = (step_m / scene.dt_s) * core::Vec3{-1.0F, -1.0F, 0.0F};
  constexpr int kFrames = 24;

  const std::unique_ptr<core::Dynamics> twin = twin_of({});
  ASSERT_TRUE(twin->load(scene).ok());
  int rejected = 0;
  int confirmed = 0;
  for (int k = 0; k < kFrames; ++k) {
    core::FrameRecord frame;
    ASSERT_TRUE(twin->step(scene.dt_s).ok());
    ASSERT_TRUE(twin->read_back(frame, core::RecordLevel::kFull).ok());
    rejected += frame.confirmed.size() < frame.pairs.size() ? 1 : 0;
    confirmed += frame.confirmed.empty() ? 0 : 1;
  }
  EXPECT_GT(rejected, 3);
  EXPECT_GT(rejected, 0);
  EXPECT_GT(confirmed, 0);
  for (const std::uint32_t least : {1U, 100U}) {
    SCOPED_TRACE(least);
    PipelineOptions options;
    options.least_for_cells = least;
    Pipeline subject(options);
    EXPECT_GT(compare_pipelines(scene, subject, *twin, kFrames, 1), 0U);
  }
}

// A frame that is copied while the next one is computed keeps its content. Two copies may be under way, a third may
// not.
TEST(PipelineOnHost, FramesAreCopiedWhileLaterOnesAreComputed) {
  const core::Scene scene = coarse_spheres(40, 2.5F);
  Pipeline subject(PipelineOptions{});
  const std::unique_ptr<core::Dynamics> twin = twin_of({});
  ASSERT_TRUE(subject.load(scene).ok());
  ASSERT_TRUE(twin->load(scene).ok());
  std::vector<core::FrameRecord> expected(9);
  core::FrameRecord copied;
  EXPECT_FALSE(subject.finish_copy(copied).ok());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const core::RecordLevel level = k % 3 == 1 ? core::RecordLevel::kDigest : core::RecordLevel::kFull;
    ASSERT_TRUE(twin->step(scene.dt_s).ok());
    ASSERT_TRUE(twin->read_back(expected[k], level).ok());
    ASSERT_TRUE(subject.step(scene.dt_s).ok());
    ASSERT_TRUE(subject.start_copy(level).ok());
    if (k == 0) continue;
    ASSERT_TRUE(subject.finish_copy(copied).ok());
    EXPECT_EQ(copied.step, k);
    EXPECT_EQ(copied.digest, expected[k - 1].digest);
    EXPECT_EQ(first_difference(copied, expected[k - 1]), "nothing that is recorded") << "frame " << k;
  }
  ASSERT_TRUE(subject.start_copy(core::RecordLevel::kFull).ok());
  EXPECT_FALSE(subject.start_copy(core::RecordLevel::kFull).ok());
}

// Digests that are asked for at regular intervals come with the frames. One that is asked for at another time, twice,
// or before the first step is computed then: all are the same.
TEST(PipelineOnHost, DigestsInAnyRhythm) {
  const core::Scene scene = coarse_spheres(40, 2.5F);
  Pipeline subject(PipelineOptions{});
  const std::unique_ptr<core::Dynamics> twin = twin_of({});
  ASSERT_TRUE(subject.load(scene).ok());
  ASSERT_TRUE(twin->load(scene).ok());
  const auto digest_of = [](core::Dynamics& engine) {
    core::FrameRecord frame;
    EXPECT_TRUE(engine.read_back(frame, core::RecordLevel::kDigest).ok());
    return frame.digest;
  };
  EXPECT_EQ(digest_of(subject), digest_of(*twin));
  for (const int steps : {1, 1, 1, 3, 3, 3, 1, 2, 1, 1}) {
    for (int k = 0; k < steps; ++k) {
      ASSERT_TRUE(subject.step(scene.dt_s).ok());
      ASSERT_TRUE(twin->step(scene.dt_s).ok());
    }
    const std::uint64_t expected = digest_of(*twin);
    EXPECT_EQ(digest_of(subject), expected);
    EXPECT_EQ(digest_of(subject), expected);
  }
}

// More bodies than the grid has threads, more than fit into a block's memory, and enough for the hashed octree.
TEST(PipelineOnHost, ManyBoxesOfManySizes) {
  SceneShape shape;
  shape.bodies = 1000;
  shape.cube_m = 7.0F;
  const core::Scene scene = thrown({box_mesh({0.5F, 0.5F, 0.5F}), box_mesh({0.2F, 0.7F, 0.1F}),
                                    box_mesh({0.02F, 0.03F, 0.02F}), box_mesh({2.0F, 1.0F, 0.3F})},
                                   shape);
  PipelineOptions options;
  options.has_vertex_stage = false;
  options.levels = core::Levels::kFlat;
  options.least_for_grid = 100;
  EXPECT_GT(compare(scene, options, {{"levels", "flat"}, {"vertex_stage", "off"}}, 2), 0U);
}

// Pairs by the thousand from one point: every buffer starts too small, and no pair is lost.
TEST(PipelineOnHost, BuffersGrow) {
  SceneShape shape;
  shape.bodies = 90;
  shape.cube_m = 0.0F;
  core::Scene scene = thrown({box_mesh({0.5F, 0.5F, 0.5F})}, shape);
  scene.domain = {{-9, -9, -9}, {9, 9, 9}};
  PipelineOptions options;
  options.has_vertex_stage = false;
  options.levels = core::Levels::kFlat;
  Pipeline subject(options);
  EXPECT_GT(compare_pipelines(scene, subject, *twin_of({{"levels", "flat"}, {"vertex_stage", "off"}}), 1, 1), 0U);
  EXPECT_EQ(subject.frame_counts().pairs, 90U * 89U / 2U);
  EXPECT_GE(subject.repeated_frames(), 1U);
}

// The same where pairs are measured: the repeated frame writes again what the aborted frame wrote.
TEST(PipelineOnHost, BuffersOfMeasuredPairsGrow) {
  SceneShape shape;
  shape.bodies = 90;
  shape.cube_m = 0.3F;
  const core::Scene scene = thrown({box_mesh({0.5F, 0.5F, 0.5F})}, shape);
  for (const std::string levels : {"flat", "C"}) {
    SCOPED_TRACE(levels);
    PipelineOptions options;
    options.levels = *core::levels_named(levels);
    Pipeline subject(options);
    EXPECT_GT(compare_pipelines(scene, subject, *twin_of({{"levels", levels}}), 3, 1), 0U);
    EXPECT_GE(subject.repeated_frames(), 1U);
  }
}

// One launch a frame and none for a copy of it; as many pairs as octree-cpu tests; memory that any machine would take.
TEST(PipelineOnHost, CountsLaunchesPairsAndBytes) {
  const core::Scene scene = coarse_spheres(40, 2.5F, 4);
  for (const char* broad : {"tree", "brute"}) {
    SCOPED_TRACE(broad);
    PipelineOptions options;
    options.levels = core::Levels::kA;
    options.broad = std::string_view(broad) == "tree" ? Broad::kTree : Broad::kBrute;
    const std::unique_ptr<core::Dynamics> twin = twin_of({{"broad", broad}, {"levels", "A"}});
    tests::Counts before;
    for (const char* seed : {"1", "2"}) {
      Pipeline subject(options);
      ASSERT_EQ(setenv("BROADSIDE_ON_HOST_SEED", seed, 1), 0);
      EXPECT_GT(compare_pipelines(scene, subject, *twin, 5, 2), 0U);
      const tests::Counts counts = tests::counts_of(subject);
      EXPECT_EQ(counts.at("launches"), 5U + subject.repeated_frames());
      EXPECT_EQ(counts.at("level stage: pairs tested"), tests::counts_of(*twin).at("level stage: pairs tested"));
      EXPECT_GT(counts.at("device bytes"), 40U * sizeof(core::Body));
      EXPECT_TRUE(before.empty() || counts == before) << "the order of threads is no part of it";
      before = counts;
    }
    unsetenv("BROADSIDE_ON_HOST_SEED");
  }
}

// Threads may come in any order: a frame is a function of the frame before it.
TEST(PipelineOnHost, AnyOrderOfThreads) {
  for (const char* seed : {"1", "2", "3"}) {
    ASSERT_EQ(setenv("BROADSIDE_ON_HOST_SEED", seed, 1), 0);
    EXPECT_GT(compare(coarse_spheres(40, 2.2F), {}, {}, 4), 0U);
  }
  unsetenv("BROADSIDE_ON_HOST_SEED");
}

}  // namespace
}  // namespace broadside::gpu

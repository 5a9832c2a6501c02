// The law of the GPU pipeline: at every frame its digest is octree-cpu's, bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "core/engine/engine.hpp"
#include "gpu/engines.hpp"
#include "gpu/engines_on_cuda.hpp"
#include "reference/engines.hpp"
#include "tests/gpu/small_scenes.hpp"
#include "tests/gpu/twin_comparison.hpp"

namespace broadside::gpu {
namespace {

using Given = std::map<std::string, std::string>;

core::Engine make(const core::EngineRow& row, const Given& given) {
  auto settings = core::Settings::parse(row.id, row.settings, given);
  EXPECT_TRUE(settings.ok()) << settings.error().line();
  auto engine = row.create(settings.value());
  EXPECT_TRUE(engine.ok()) << engine.error().line();
  return std::move(engine).value();
}

class Twin : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = gpu_absent(); !why.empty()) GTEST_SKIP() << "not run: " << why;
  }

  static std::uint64_t compare(const core::Scene& scene, const Given& gpu, const Given& cpu, int frames) {
    core::Engine subject = make(octree_gpu_row(), gpu);
    core::Engine twin = make(reference::octree_cpu_row(), cpu);
    return compare_pipelines(scene, *subject.dynamics, *twin.dynamics, frames);
  }

  static std::uint64_t compare(const core::Scene& scene, const Given& both, int frames) {
    return compare(scene, both, both, frames);
  }
};

core::Scene spheres(std::uint32_t bodies, float cube_m) {
  SceneShape shape;
  shape.bodies = bodies;
  shape.cube_m = cube_m;
  return thrown({bumpy_sphere(12, 0.5F), bumpy_sphere(25, 0.6F)}, shape);
}

TEST_F(Twin, EveryLevelFromItsPublishedStart) {
  for (const std::string levels : {"flat", "level1", "A", "B", "C"}) {
    SCOPED_TRACE(levels);
    EXPECT_GT(compare(spheres(60, 4.0F), {{"broad", "brute"}, {"levels", levels}}, 600), 0U);
  }
}

TEST_F(Twin, EveryLevelFromTheTree) {
  for (const std::string levels : {"flat", "level1", "A", "B", "C"}) {
    SCOPED_TRACE(levels);
    EXPECT_GT(compare(spheres(60, 4.0F), {{"broad", "tree"}, {"levels", levels}},
                      {{"broad", "brute"}, {"levels", levels}}, 100),
              0U);
  }
}

// Without cells, for fine spheres in each other: a few pairs, whose searches are handed over to the whole grid.
TEST_F(Twin, LongSearchesThatTheGridShares) {
  SceneShape shape;
  for (const std::uint32_t bodies : {2U, 9U, 15U}) {
    shape.bodies = bodies;
    shape.cube_m = 0.6F * std::cbrt(static_cast<float>(bodies));
    for (const std::string levels : {"flat", "C"}) {
      SCOPED_TRACE(levels + " " + std::to_string(bodies));
      EXPECT_GT(compare(thrown({bumpy_sphere(70, 0.5F), bumpy_sphere(50, 0.6F)}, shape), {{"levels", levels}}, 100),
                0U);
    }
  }
}

TEST_F(Twin, WithoutTheVertexStage) {
  SceneShape shape;
  shape.bodies = 200;
  shape.cube_m = 5.0F;
  const core::Scene scene = thrown({box_mesh({0.5F, 0.5F, 0.5F}), box_mesh({0.2F, 0.7F, 0.4F})}, shape);
  EXPECT_GT(compare(scene, {{"broad", "brute"}, {"vertex_stage", "off"}}, 600), 0U);
}

TEST_F(Twin, JacobiAndEveryPrintedFormOfTheResponse) {
  EXPECT_GT(compare(spheres(60, 4.0F), {{"broad", "brute"}, {"solver", "jacobi"}}, 200), 0U);
  for (const std::string variant : {"printed-E3", "printed-E4", "printed-E5", "printed-E6"}) {
    SCOPED_TRACE(variant);
    EXPECT_GT(compare(spheres(60, 4.0F), {{"broad", "brute"}, {"variant", variant}}, 200), 0U);
  }
}

TEST_F(Twin, PublishedOctreeAndItsPrintedForms) {
  EXPECT_GT(compare(spheres(60, 4.0F), {{"broad", "octree"}}, 200), 0U);
  for (const std::string variant : {"printed-E2", "printed-E7"}) {
    SCOPED_TRACE(variant);
    EXPECT_GT(compare(spheres(60, 4.0F), {{"variant", variant}}, 200), 0U);
  }
}

TEST_F(Twin, SpatialHash) {
  for (const std::string cell_mm : {"0", "100", "20", "3000"}) {
    SCOPED_TRACE(cell_mm);
    SceneShape shape;
    shape.static_every = 5;
    const core::Scene scene = thrown({bumpy_sphere(12, 0.5F), bumpy_sphere(25, 0.6F)}, shape);
    core::Engine subject = make(hash_gpu_row(), {{"cell_mm", cell_mm}});
    core::Engine twin = make(reference::hash_cpu_row(), {{"cell_mm", cell_mm}});
    EXPECT_GT(compare_pipelines(scene, *subject.dynamics, *twin.dynamics, 100), 0U);
  }
}

TEST_F(Twin, NoBodyAndOneBody) {
  compare(spheres(0, 4.0F), {{"broad", "brute"}}, 3);
  EXPECT_GT(compare(spheres(1, 4.0F), {{"broad", "brute"}}, 600), 0U);  // it meets the domain's faces
}

TEST_F(Twin, StaticBodies) {
  SceneShape shape;
  shape.static_every = 3;
  EXPECT_GT(compare(thrown({bumpy_sphere(12, 0.5F)}, shape), {{"broad", "brute"}}, 300), 0U);
  // Static bodies are moved because of the swapped masses, which is how that form shows.
  EXPECT_GT(compare(thrown({bumpy_sphere(12, 0.5F)}, shape), {{"variant", "printed-E3"}}, 300), 0U);
  EXPECT_GT(compare(thrown({bumpy_sphere(12, 0.5F)}, shape), {{"solver", "jacobi"}}, 300), 0U);
  shape.static_every = 1;
  EXPECT_EQ(compare(thrown({bumpy_sphere(12, 0.5F)}, shape), {{"broad", "brute"}}, 3), 0U);
}

TEST_F(Twin, Springs) {
  core::Scene scene = spheres(60, 4.0F);
  add_springs(scene, 45);
  EXPECT_GT(compare(scene, {{"broad", "brute"}}, 300), 0U);
}

// Numbers of bodies around those at which the start changes: that of the warps, half a ring, and 32.
TEST_F(Twin, FewBodiesOfEveryNumber) {
  for (const std::uint32_t bodies : {2U, 3U, 31U, 32U, 64U, 65U, 91U, 92U, 129U, 364U, 365U, 511U, 512U, 513U}) {
    SCOPED_TRACE(bodies);
    const core::Scene scene = spheres(bodies, 0.8F * std::cbrt(static_cast<float>(bodies)));
    for (const std::string levels : {"flat", "A", "C"})
      compare(scene, {{"levels", levels}}, {{"broad", "brute"}, {"levels", levels}}, 20);
  }
}

// 80 bodies at one point have 3160 contacts, all of which conflict: no other case makes contacts wait for each other as
// often.
TEST_F(Twin, AllAtOnePoint) {
  SceneShape shape;
  shape.bodies = 80;
  shape.cube_m = 0.0F;
  core::Scene scene = thrown({bumpy_sphere(5, 0.5F)}, shape);
  scene.domain = {{-9, -9, -9}, {9, 9, 9}};
  EXPECT_GT(compare(scene, {{"broad", "brute"}}, 40), 0U);
}

// More bodies than brute force and one block take: the hashed octree, and every stage by the whole grid.
TEST_F(Twin, ThousandsOfBodiesOfManySizes) {
  SceneShape shape;
  shape.bodies = 5000;
  shape.cube_m = 14.0F;
  const core::Scene scene = thrown(
      {bumpy_sphere(6, 0.5F), bumpy_sphere(4, 0.2F), box_mesh({0.03F, 0.03F, 0.03F}), bumpy_sphere(40, 2.5F)}, shape);
  EXPECT_GT(compare(scene, {{"broad", "tree"}}, {{"broad", "brute"}}, 12), 0U);
}

TEST_F(Twin, RandomScenes) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    SceneShape shape;
    shape.seed = seed;
    shape.bodies = 20 + static_cast<std::uint32_t>(200.0F * dice.next());
    shape.cube_m = 2.0F + 6.0F * dice.next();
    shape.speed_m_s = 20.0F * dice.next();
    shape.static_every = seed % 2 == 0 ? 7 : 0;
    const auto rings = 3 + static_cast<std::uint32_t>(20.0F * dice.next());
    const core::Scene scene =
        thrown({bumpy_sphere(rings, 0.3F + 0.5F * dice.next()), box_mesh({0.4F, 0.3F, 0.2F})}, shape);
    compare(scene, {{"broad", "tree"}}, {{"broad", "brute"}}, 100);
  }
}

}  // namespace
}  // namespace broadside::gpu

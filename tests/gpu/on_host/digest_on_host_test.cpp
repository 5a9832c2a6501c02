// Digests of frames that are copied while the next frames are computed, as a recorded run asks for them. They arrive
// later than the frame, and equal octree-cpu's.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "gpu/frame/pipeline.hpp"
#include "tests/gpu/octree_cpu_twin.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

using Digests = std::vector<std::uint64_t>;

// The digest of the initial state, then one after every `every` steps.
Digests digests_of_twin(const core::Scene& scene, const Given& given, int frames, int every) {
  const std::unique_ptr<core::Dynamics> twin = twin_of(given);
  EXPECT_TRUE(twin->load(scene).ok());
  Digests digests;
  for (int k = 0; k <= frames; ++k) {
    if (k > 0) {
      EXPECT_TRUE(twin->step(scene.dt_s).ok());
    }
    if (k % every != 0) continue;
    core::FrameRecord frame;
    EXPECT_TRUE(twin->read_back(frame, core::RecordLevel::kDigest).ok());
    digests.push_back(frame.digest);
  }
  return digests;
}

Digests digests_of_copies(const core::Scene& scene, Pipeline& subject, int frames, int every) {
  EXPECT_TRUE(subject.load(scene).ok());
  Digests digests;
  const auto finish = [&] {
    core::FrameRecord frame;
    EXPECT_TRUE(subject.finish_copy(frame).ok());
    EXPECT_EQ(frame.step, digests.size() * static_cast<std::uint64_t>(every));
    digests.push_back(frame.digest);
  };
  bool is_under_way = false;
  for (int k = 0; k <= frames; ++k) {
    if (k > 0) {
      EXPECT_TRUE(subject.step(scene.dt_s).ok());
    }
    if (k % every != 0) continue;
    EXPECT_TRUE(subject.start_copy(core::RecordLevel::kDigest).ok());
    if (is_under_way) finish();
    is_under_way = true;
  }
  finish();
  return digests;
}

// The host's grid has two blocks of 64 threads: with 40 bodies one block resolves contacts, with 80 there is a thread
// for each body, and with 150 the thread that reaches a contact last applies it.
TEST(DigestOnHost, OfEveryKindOfFrame) {
  struct Case {
    const char* name;
    std::uint32_t bodies;
    PipelineOptions options;
    Given given;
  };
  std::vector<Case> cases;
  for (const std::uint32_t bodies : {1U, 40U, 80U}) {
    cases.push_back({"tree", bodies, {}, {}});
    PipelineOptions options;
    options.solver = Solver::kJacobi;
    cases.push_back({"jacobi", bodies, options, {{"solver", "jacobi"}}});
    options = {};
    options.least_for_grid = 50;
    options.levels = core::Levels::kFlat;
    options.has_vertex_stage = false;
    cases.push_back({"grid, flat, no vertices", bodies, options, {{"levels", "flat"}, {"vertex_stage", "off"}}});
  }
  PipelineOptions many;
  many.levels = core::Levels::kFlat;
  many.has_vertex_stage = false;
  cases.push_back({"many, flat, no vertices", 150, many, {{"levels", "flat"}, {"vertex_stage", "off"}}});
  for (const Case& c : cases) {
    const core::Scene scene = coarse_spheres(c.bodies, c.bodies > 64 ? 2.8F : 2.2F, 7);
    for (const int every : {1, 2}) {
      SCOPED_TRACE(std::string(c.name) + ", " + std::to_string(c.bodies) + ", every " + std::to_string(every));
      const Digests expected = digests_of_twin(scene, c.given, 4, every);
      for (const char* seed : {"0", "1"}) {
        ASSERT_EQ(setenv("BROADSIDE_ON_HOST_SEED", seed, 1), 0);
        Pipeline subject(c.options);
        EXPECT_EQ(digests_of_copies(scene, subject, 4, every), expected);
        EXPECT_EQ(subject.frame_counts().touching > 0, c.bodies > 1);
        EXPECT_EQ(subject.frame_counts().faces > 0, c.bodies > 1);
      }
      unsetenv("BROADSIDE_ON_HOST_SEED");
    }
  }
}

// Ten bodies lie in each other; a wide lattice of eighty more arrives at the same place in the second frame, whose
// buffers are too small. That frame is repeated while the digest of the first frame's contacts is still due.
TEST(DigestOnHost, WhileBuffersGrow) {
  SceneShape shape;
  shape.bodies = 90;
  core::Scene scene = thrown({box_mesh({0.5F, 0.5F, 0.5F})}, shape);
  scene.domain = {{-40, -40, -40}, {40, 40, 40}};
  scene.parameters.v_max_m_s = 1e6F;
  for (std::uint32_t i = 0; i < 90; ++i) {
    core::Body& body = scene.bodies[i];
    body.position = {0.05F * static_cast<float>(i), 0.0F, 0.0F};
    body.velocity = {};
    if (i < 10) continue;
    const auto place = [](std::uint32_t k) { return 4.0F * static_cast<float>(k) - 10.0F; };
    body.position = {place(i % 5), place(i / 5 % 5), place(i / 25) + 24.0F};
    body.velocity = (-0.5F / scene.dt_s) * body.position;
  }
  constexpr int kFrames = 4;
  PipelineOptions options;
  options.has_vertex_stage = false;
  options.levels = core::Levels::kFlat;
  Pipeline subject(options);
  EXPECT_EQ(digests_of_copies(scene, subject, kFrames, 1),
            digests_of_twin(scene, {{"levels", "flat"}, {"vertex_stage", "off"}}, kFrames, 1));
  EXPECT_GE(subject.repeated_frames(), 1U);
  EXPECT_GT(subject.frame_counts().touching, 0U);
}

}  // namespace
}  // namespace broadside::gpu

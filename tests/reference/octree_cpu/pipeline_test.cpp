// The CPU twin as a whole: what a frame must be, whatever the setting and the number of threads.
#include "reference/octree_cpu/pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "reference/engines.hpp"

namespace broadside::reference {
namespace {

using core::Vec3;

// A cube of side 1 whose faces carry an n x n grid of vertices: dense enough for vertex proximity to see a face.
std::shared_ptr<core::Mesh> grid_cube(int n) {
  auto mesh = std::make_shared<core::Mesh>();
  mesh->name = "grid-cube";
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-0.5F, 0.5F}) {
      const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
      for (int p = 0; p <= n; ++p) {
        for (int q = 0; q <= n; ++q) {
          Vec3 v;
          v[axis] = side;
          v[(axis + 1) % 3] = -0.5F + static_cast<float>(p) / static_cast<float>(n);
          v[(axis + 2) % 3] = -0.5F + static_cast<float>(q) / static_cast<float>(n);
          mesh->vertices.push_back(v);
        }
      }
      const auto at = [&](int p, int q) { return first + static_cast<std::uint32_t>(p * (n + 1) + q); };
      for (int p = 0; p < n; ++p) {
        for (int q = 0; q < n; ++q) {
          mesh->triangles.push_back({at(p, q), at(p + 1, q), at(p + 1, q + 1)});
          mesh->triangles.push_back({at(p, q), at(p + 1, q + 1), at(p, q + 1)});
        }
      }
    }
  }
  return mesh;
}

core::Scene cubes(const std::vector<Vec3>& positions, int cells = 6) {
  core::Scene scene;
  scene.name = "cubes";
  scene.meshes.push_back(grid_cube(cells));
  for (const Vec3 x : positions) {
    core::Body body;
    body.position = x;
    scene.bodies.push_back(body);
  }
  scene.domain = {{-4, -4, -4}, {4, 4, 4}};
  return scene;
}

// A heap that falls into itself: 27 cubes, off the lattice by an irrational step so that no two boxes are aligned.
core::Scene heap(int cells = 6) {
  std::vector<Vec3> positions;
  for (int k = 0; k < 27; ++k) {
    const auto jitter = static_cast<float>(std::fmod(k * 0.618034, 1.0) - 0.5);
    positions.push_back({1.05F * static_cast<float>(k % 3) + 0.1F * jitter, 1.05F * static_cast<float>(k / 9) - 2.0F,
                         1.05F * static_cast<float>(k / 3 % 3) - 0.08F * jitter});
  }
  core::Scene scene = cubes(positions, cells);
  scene.gravity_m_s2 = {0, -9.81F, 0};
  scene.domain = {{-1, -3, -1}, {3.2F, 6, 3.2F}};
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) scene.bodies[k].inverse_mass = k % 5 == 0 ? 0.25F : 1.0F;
  scene.bodies[4].inverse_mass = 0.0F;
  return scene;
}

std::vector<core::FrameRecord> run(const core::Scene& scene, const PipelineOptions& options, int frames) {
  Pipeline pipeline(options);
  EXPECT_TRUE(pipeline.load(scene).ok());
  std::vector<core::FrameRecord> out(static_cast<std::size_t>(frames));
  for (core::FrameRecord& frame : out) {
    EXPECT_TRUE(pipeline.step(scene.dt_s).ok());
    EXPECT_TRUE(pipeline.read_back(frame, core::RecordLevel::kFull).ok());
  }
  return out;
}

std::size_t contacts_of(const std::vector<core::FrameRecord>& frames) {
  std::size_t n = 0;
  for (const auto& f : frames) n += f.contacts.size();
  return n;
}

TEST(Pipeline, FreeFallFollowsTheDiscreteSolution) {
  core::Scene scene = cubes({{0, 0, 0}});
  scene.gravity_m_s2 = {0, -10.0F, 0};
  scene.dt_s = 0.03125F;
  const auto frames = run(scene, {}, 8);
  // Semi-implicit Euler from rest: v_n = n g dt, x_n = g dt^2 n (n + 1) / 2; exact in binary for these numbers.
  EXPECT_EQ(frames[7].velocity[0].y, -10.0F * 0.03125F * 8);
  EXPECT_EQ(frames[7].position[0].y, -10.0F * 0.03125F * 0.03125F * 36);
}

TEST(Pipeline, HeadOnPairOfEqualMassesBouncesWithRestitution) {
  core::Scene scene = cubes({{0, 0, 0}, {1.01F, 0, 0}});
  scene.bodies[0].velocity = {2, 0, 0};
  scene.bodies[1].velocity = {-2, 0, 0};
  scene.bodies[0].material.restitution = 0.5F;
  scene.bodies[1].material.restitution = 0.5F;
  const auto frames = run(scene, {}, 1);
  ASSERT_EQ(frames[0].contacts.size(), 1U);
  EXPECT_EQ(frames[0].contacts[0].normal, (Vec3{-1, 0, 0}));  // from B (right) to A (left)
  EXPECT_FLOAT_EQ(frames[0].velocity[0].x, -1.0F);
  EXPECT_FLOAT_EQ(frames[0].velocity[1].x, 1.0F);
  // beta = 1: the pair is left at the slop.
  const float depth = 1.0F - (frames[0].position[1].x - frames[0].position[0].x);
  EXPECT_NEAR(depth, scene.parameters.delta_m, 4 * 0x1p-24);
}

TEST(Pipeline, EveryThreadCountGivesTheSameBits) {
  const core::Scene scene = heap();
  PipelineOptions one;
  one.threads = 1;
  PipelineOptions two;
  two.threads = 2;
  const auto a = run(scene, one, 60);
  const auto b = run(scene, two, 60);
  ASSERT_GT(contacts_of(a), 100U) << "a heap without contacts would show nothing";
  for (std::size_t k = 0; k < a.size(); ++k) ASSERT_EQ(a[k].digest, b[k].digest) << "step " << k + 1;
}

// oneTBB warns on stderr, once a process, when an arena asks for more threads than there are cores.
TEST(Pipeline, MoreThreadsThanCoresAreAsMany) {
  const auto digests_of = [](const std::string& threads) {
    std::vector<std::uint64_t> digests;
    const core::EngineRow row = octree_cpu_row();
    const auto settings = core::Settings::parse(row.id, row.settings, {{"threads", threads}});
    const auto engine = row.create(settings.value());
    const core::Scene scene = heap();
    EXPECT_TRUE(engine.value().dynamics->load(scene).ok());
    for (int frame = 0; frame < 10; ++frame) {
      core::FrameRecord record;
      EXPECT_TRUE(engine.value().dynamics->step(scene.dt_s).ok());
      EXPECT_TRUE(engine.value().dynamics->read_back(record, core::RecordLevel::kDigest).ok());
      digests.push_back(record.digest);
    }
    return digests;
  };
  testing::internal::CaptureStderr();
  const auto of_many = digests_of("1000");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(of_many, digests_of("1"));
}

TEST(Pipeline, LevelsABCAgreeAndFlatContainsThem) {
  const core::Scene scene = heap();
  PipelineOptions options;
  options.levels = core::Levels::kC;
  const auto c = run(scene, options, 60);
  options.levels = core::Levels::kA;
  const auto a = run(scene, options, 60);
  options.levels = core::Levels::kB;
  const auto b = run(scene, options, 60);
  options.levels = core::Levels::kFlat;
  const auto flat = run(scene, options, 1);
  for (std::size_t k = 0; k < c.size(); ++k) {
    ASSERT_EQ(a[k].digest, c[k].digest) << "step " << k + 1;
    ASSERT_EQ(b[k].digest, c[k].digest) << "step " << k + 1;
  }
  for (const core::Pair p : c[0].confirmed)
    EXPECT_NE(std::find(flat[0].confirmed.begin(), flat[0].confirmed.end(), p), flat[0].confirmed.end());
}

// The culled search must give the result of trying every pair of vertices, in the same float arithmetic. Returns how
// many pairs touch.
std::size_t check_proximity(const core::Scene& scene, int steps) {
  const auto frames = run(scene, {}, steps);
  const auto& v = scene.meshes[0]->vertices;
  const float theta = core::mean_edge_m(*scene.meshes[0]);
  std::size_t touching = 0;
  for (const auto& frame : frames) {
    for (std::size_t k = 0; k < frame.confirmed.size(); ++k) {
      const auto [i, j] = frame.confirmed[k];
      core::Proximity nearest;
      for (std::uint32_t p = 0; p < v.size(); ++p) {
        const Vec3 a = v[p] + frame.detected_position[i];
        for (std::uint32_t q = 0; q < v.size(); ++q) {
          const Vec3 d = a - (v[q] + frame.detected_position[j]);
          const float d2 = d.x * d.x + d.y * d.y + d.z * d.z;
          if (d2 < theta * theta && d2 < nearest.squared_distance_m2) nearest = {d2, p, q};
        }
      }
      EXPECT_EQ(frame.proximity[k], nearest) << "step " << frame.step << " pair " << i << " " << j;
      touching += nearest.is_touching() ? 1 : 0;
    }
  }
  return touching;
}

TEST(Pipeline, ProximityIsThatOfAllVertexPairs) {
  EXPECT_GT(check_proximity(heap(), 20), 50U);
}

// 40 vertices a leaf, so that leaves are searched by boxes of their own; on a grid, many pairs are equally near.
TEST(Pipeline, ProximityIsThatOfAllVertexPairsInLeavesOfManyVertices) {
  EXPECT_GT(check_proximity(heap(20), 3), 5U);
}

TEST(Pipeline, MassRatioDecidesWhoIsMoved) {
  core::Scene scene = cubes({{0, 0, 0}, {0.95F, 0, 0}, {0, 2.5F, 0}, {0, 3.45F, 0}});
  scene.bodies[1].inverse_mass = 0.25F;
  scene.bodies[3].inverse_mass = 0.0F;
  const auto frames = run(scene, {}, 1);
  const float above_slop = 0.05F - scene.parameters.delta_m;
  EXPECT_NEAR(frames[0].position[0].x, -above_slop * 0.8F, 1e-6F);
  EXPECT_NEAR(frames[0].position[1].x, 0.95F + above_slop * 0.2F, 1e-6F);
  EXPECT_EQ(frames[0].position[3], (Vec3{0, 3.45F, 0}));
  EXPECT_NEAR(frames[0].position[2].y, 2.5F - above_slop, 1e-6F);
}

TEST(Pipeline, VelocityIsClippedByComponent) {
  core::Scene scene = cubes({{0, 0, 0}});
  scene.bodies[0].velocity = {60, -70, 3};
  const auto frames = run(scene, {}, 1);
  EXPECT_EQ(frames[0].velocity[0], (Vec3{50, -50, 3}));
}

TEST(Pipeline, NoBodyAndOneBodyAndAllAtOnePoint) {
  EXPECT_EQ(run(cubes({}), {}, 3).back().step, 3U);
  EXPECT_EQ(run(cubes({{0, 0, 0}}), {}, 3).back().confirmed.size(), 0U);
  const auto heap_at_point = run(cubes(std::vector<Vec3>(6, Vec3{0, 0, 0})), {}, 3);
  EXPECT_EQ(heap_at_point[0].confirmed.size(), 15U);
  for (const Vec3 x : heap_at_point.back().position) EXPECT_TRUE(std::isfinite(x.x));
  EXPECT_EQ(heap_at_point[0].contacts[0].normal, (Vec3{1, 0, 0})) << "coincident centers take the fixed axis";
}

// Where all pairs are tested by their boxes alone, the time counts as the broad phase's, as on the GPU; from level 1 on
// it counts as the levels'. Half a million tests are compared with none, so the clock cannot err.
TEST(Pipeline, ThePublishedStartOfLevel0IsTimedAsTheBroadPhase) {
  std::vector<Vec3> line;
  for (int k = 0; k < 1000; ++k) line.push_back({2.0F * static_cast<float>(k), 0, 0});
  const core::Scene scene = cubes(line, 1);
  for (const core::Levels levels : {core::Levels::kFlat, core::Levels::kB}) {
    PipelineOptions options;
    options.levels = levels;
    Pipeline pipeline(options);
    ASSERT_TRUE(pipeline.load(scene).ok());
    ASSERT_TRUE(pipeline.step(scene.dt_s).ok());
    double broad_s = 0.0;
    double levels_s = 0.0;
    for (const core::StageTime& time : pipeline.stage_times()) {
      if (time.stage == "broad") broad_s = time.seconds;
      if (time.stage == "levels") levels_s = time.seconds;
    }
    EXPECT_EQ(broad_s > levels_s, levels == core::Levels::kFlat) << broad_s << " s and " << levels_s << " s";
  }
}

TEST(Pipeline, SpinIsRefused) {
  core::Scene scene = cubes({{0, 0, 0}});
  scene.bodies[0].angular_velocity = {0, 1, 0};
  Pipeline pipeline(PipelineOptions{});
  const core::Status status = pipeline.load(scene);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().line().find("body 0"), std::string::npos);
}

}  // namespace
}  // namespace broadside::reference

// `hash-cpu` differs from the pipeline only in where candidates come from. An exact candidate set is unique, so every
// frame must be the same, bit for bit, for any cell size and number of threads.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/engine/engine.hpp"
#include "reference/engines.hpp"

namespace broadside {
namespace {

core::Engine engine_of_row(const core::EngineRow& row, const std::map<std::string, std::string>& given) {
  auto settings = core::Settings::parse(row.id, row.settings, given);
  EXPECT_TRUE(settings.ok());
  auto engine = row.create(settings.value());
  EXPECT_TRUE(engine.ok());
  return std::move(engine).value();
}

// A tower of octahedra that falls onto the floor of the domain and onto itself.
core::Scene tower() {
  core::Mesh mesh;
  mesh.name = "octahedron";
  mesh.source = "procedural";
  mesh.vertices = {{0.5F, 0, 0}, {-0.5F, 0, 0}, {0, 0.5F, 0}, {0, -0.5F, 0}, {0, 0, 0.5F}, {0, 0, -0.5F}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  core::Scene scene;
  scene.name = "tower";
  scene.meshes.push_back(std::make_shared<const core::Mesh>(mesh));
  scene.domain = {{-2, 0, -2}, {2, 12, 2}};
  scene.gravity_m_s2 = {0, -9.81F, 0};
  scene.dt_s = 0.01F;
  scene.frames = 60;
  for (int k = 0; k < 8; ++k) {
    core::Body body;
    body.position = {0.03F * static_cast<float>(k % 3), 0.6F + 1.05F * static_cast<float>(k), 0};
    scene.bodies.push_back(body);
  }
  return scene;
}

TEST(HashCpu, EveryFrameIsThePipelinesOwn) {
  const core::Scene scene = tower();
  ASSERT_TRUE(core::check_scene(scene).ok());
  std::vector<core::Engine> engines;
  engines.push_back(engine_of_row(reference::octree_cpu_row(), {}));
  engines.push_back(engine_of_row(reference::hash_cpu_row(), {}));
  engines.push_back(engine_of_row(reference::hash_cpu_row(), {{"cell_mm", "90"}, {"threads", "1"}}));
  for (core::Engine& engine : engines) ASSERT_TRUE(engine.dynamics->load(scene).ok());
  std::size_t contacts = 0;
  for (std::uint32_t frame = 1; frame <= scene.frames; ++frame) {
    std::vector<core::FrameRecord> records(engines.size());
    for (std::size_t k = 0; k < engines.size(); ++k) {
      ASSERT_TRUE(engines[k].dynamics->step(scene.dt_s).ok());
      ASSERT_TRUE(engines[k].dynamics->read_back(records[k], core::RecordLevel::kFull).ok());
      ASSERT_EQ(records[k].position, records[0].position) << "engine " << k << ", frame " << frame;
      ASSERT_EQ(records[k].velocity, records[0].velocity) << "engine " << k << ", frame " << frame;
      ASSERT_EQ(records[k].confirmed, records[0].confirmed) << "engine " << k << ", frame " << frame;
    }
    contacts += records[0].contacts.size();
  }
  EXPECT_GT(contacts, 20U) << "nothing met: the test would show nothing";
}

}  // namespace
}  // namespace broadside

// Level A computed in columns gives the same answers and counts as level A test by test.
#include "reference/octree_cpu/leaf_boxes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/method/levels.hpp"

namespace broadside::reference {
namespace {

using core::Vec3;

// Vertices at irrational steps in a box: octrees with many leaves, and empty octants for few vertices.
std::shared_ptr<core::Mesh> cloud(int vertices) {
  auto mesh = std::make_shared<core::Mesh>();
  mesh->name = "cloud";
  for (int k = 0; k < vertices; ++k)
    mesh->vertices.push_back({static_cast<float>(std::fmod(k * 0.7548777, 1.0)),
                              static_cast<float>(std::fmod(k * 0.5698403, 1.0)),
                              static_cast<float>(std::fmod(k * 0.4301597, 1.0))});
  for (std::uint32_t k = 0; k + 2 < mesh->vertices.size(); k += 3) mesh->triangles.push_back({k, k + 1, k + 2});
  return mesh;
}

TEST(LeafBoxes, AreLevelATestByTest) {
  core::Scene scene;
  scene.name = "clouds";
  for (const int vertices : {3, 20, 300, 900}) scene.meshes.push_back(cloud(vertices));
  for (int k = 0; k < 60; ++k) {
    core::Body body;
    body.mesh = static_cast<std::uint32_t>(k % 4);
    body.position = {static_cast<float>(3.0 * std::fmod(k * 0.8191725, 1.0)),
                     static_cast<float>(3.0 * std::fmod(k * 0.6710436, 1.0)),
                     static_cast<float>(3.0 * std::fmod(k * 0.5497005, 1.0))};
    scene.bodies.push_back(body);
  }
  const Bodies bodies = make_bodies(scene);
  LeafBoxes leaves;
  leaves.place(bodies);
  std::size_t overlapping = 0;
  for (std::uint32_t i = 0; i < bodies.count(); ++i) {
    for (std::uint32_t j = 0; j < bodies.count(); ++j) {
      std::uint64_t expected_tests = 0;
      std::uint64_t tests = 0;
      const bool expected =
          core::is_confirmed(core::Levels::kA, bodies.shapes[bodies.shape[i]].boxes, bodies.state[i].x,
                             bodies.shapes[bodies.shape[j]].boxes, bodies.state[j].x, expected_tests);
      EXPECT_EQ(leaves.overlap(i, j, tests), expected) << i << " " << j;
      EXPECT_EQ(tests, expected_tests) << i << " " << j;
      overlapping += expected && i != j ? 1 : 0;
    }
  }
  EXPECT_GT(overlapping, 50U);
  EXPECT_LT(overlapping, 3000U) << "of 3540";
}

}  // namespace
}  // namespace broadside::reference

// FCL held against the arbiter on the method's Bunny: two programs with nothing in common but the mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/engine/engine.hpp"
#include "core/mesh/load_mesh.hpp"
#include "reference/engines.hpp"

namespace broadside {
namespace {

using core::Pose;
using core::Separation;

std::vector<Separation> measure(const core::EngineRow& row, const std::map<std::string, std::string>& given,
                                const core::Scene& scene, const std::vector<core::Pair>& pairs,
                                const std::vector<Pose>& poses) {
  auto settings = core::Settings::parse(row.id, row.settings, given);
  EXPECT_TRUE(settings.ok());
  auto engine = row.create(settings.value());
  EXPECT_TRUE(engine.ok());
  EXPECT_TRUE(engine.value().narrow_phase->load(scene).ok());
  EXPECT_TRUE(engine.value().narrow_phase->measure(pairs, poses).ok());
  return engine.value().narrow_phase->read_back().value();
}

// Scaled so that the longest side of its box is 1 m, around the origin, as in the method's scenes.
core::Mesh unit_size(core::Mesh mesh) {
  const core::Box box = core::bounds(mesh);
  const core::Vec3 size = box.max - box.min;
  const float scale = 1.0F / std::max({size.x, size.y, size.z});
  for (core::Vec3& v : mesh.vertices) v = scale * (v - core::center(box));
  return mesh;
}

TEST(RealMesh, FclAgreesWithTheArbiterOnTheBunny) {
  const char* folder = std::getenv("BROADSIDE_MESH_DIR");
  if (folder == nullptr) GTEST_SKIP() << "BROADSIDE_MESH_DIR is not set: no Bunny to measure";
  const std::filesystem::path file = std::filesystem::path(folder) / "bunny_2503v_4968t.ply";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no bunny_2503v_4968t.ply in BROADSIDE_MESH_DIR";
  auto loaded = core::load_mesh(file);
  ASSERT_TRUE(loaded.ok()) << loaded.error().line();
  const auto bunny = std::make_shared<const core::Mesh>(unit_size(loaded.value().mesh));

  core::Scene scene;
  scene.meshes = {bunny};
  std::vector<Pose> poses;
  std::vector<core::Pair> pairs;
  std::mt19937 random(13);
  std::uniform_real_distribution<float> at(-0.8F, 0.8F);
  std::normal_distribution<float> turn;
  for (std::uint32_t k = 0; k < 9; ++k) {
    core::Quat q{turn(random), turn(random), turn(random), turn(random)};
    const float norm = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    q = {q.w / norm, q.x / norm, q.y / norm, q.z / norm};
    poses.push_back({{at(random), at(random), at(random)}, q});
    scene.bodies.emplace_back();
    scene.bodies.back().orientation = q;
    for (std::uint32_t i = 0; i < k; ++i) pairs.push_back({i, k});
  }
  const std::vector<Separation> fcl = measure(reference::fcl_mesh_row(), {}, scene, pairs, poses);
  const std::vector<Separation> exact = measure(reference::exact_mesh_row(), {}, scene, pairs, poses);
  const std::vector<Separation> vertices =
      measure(reference::exact_mesh_row(), {{"method", "vertices-brute"}}, scene, pairs, poses);

  // The arbiter's vertices are turned and moved in float, FCL's in double. Turning takes about ten roundings of values
  // of up to 1 m, moving one of up to 2 m: 12 * 2^-24 m a coordinate, sqrt(3) of it a vertex, twice for two bodies.
  const double band = 2.0 * std::sqrt(3.0) * 12.0 * std::ldexp(1.0, -24);
  const double cover = 2.0 * core::covering_radius_m(*bunny);
  int apart = 0;
  int touching = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    EXPECT_NEAR(fcl[k].distance_m, exact[k].distance_m, band) << pairs[k].i << ' ' << pairs[k].j;
    if (exact[k].distance_m > band) {
      ++apart;
      EXPECT_FALSE(fcl[k].is_touching);
      EXPECT_LE(exact[k].distance_m, vertices[k].distance_m);
      EXPECT_LE(vertices[k].distance_m, exact[k].distance_m + cover + band) << "METHOD 3";
    } else if (exact[k].is_touching) {
      ++touching;
      EXPECT_TRUE(fcl[k].is_touching);
    }
  }
  EXPECT_GT(apart, 5);
  EXPECT_GT(touching, 5);
}

}  // namespace
}  // namespace broadside

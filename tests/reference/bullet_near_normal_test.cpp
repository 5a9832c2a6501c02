// Bullet's normals of bodies less than a millimeter apart, in closed form: which of them are wrong, and that our
// reading of them is not the cause.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/capsule_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"
#include "reference/engines.hpp"

namespace broadside {
namespace {

using core::Vec3;

// B is a mesh that ends 0.25 m below its origin. It lies above the upper face of box A, and both are turned by q.
// Returns the share of normals that are off by more than a degree, and the engine's hits.
struct Seen {
  int wrong = 0;
  int wrong_distance = 0;
  std::uint64_t hits = 0;
};

Seen look(const core::Mesh& above, const std::string& margin, bool is_turned, double gap_m) {
  const core::EngineRow row = reference::bullet_shapes_row();
  auto made = row.create(core::Settings::parse(row.id, row.settings, {{"margin", margin}}).value());
  core::Engine engine = std::move(made).value();
  core::Scene scene;
  scene.meshes = {std::make_shared<const core::Mesh>(datasets::box_mesh({1.0, 0.5, 1.0}, {1, 1, 1}).value()),
                  std::make_shared<const core::Mesh>(above)};
  scene.bodies.resize(2);
  scene.bodies[1].mesh = 1;
  EXPECT_TRUE(engine.narrow_phase->load(scene).ok());
  std::mt19937 random(5);
  std::uniform_real_distribution<float> at(-1.0F, 1.0F);
  Seen seen;
  for (int k = 0; k < 200; ++k) {
    core::Quat q{};
    if (is_turned) {
      q = {at(random), at(random), at(random), at(random)};
      const float size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
      q = {q.w / size, q.x / size, q.y / size, q.z / size};
    }
    const Vec3 offset{0.4F * at(random), 0.5F + static_cast<float>(gap_m), 0.4F * at(random)};
    const std::vector<core::Pose> poses{{{}, q}, {core::rotate(q, offset), q}};
    EXPECT_TRUE(engine.narrow_phase->measure(std::vector<core::Pair>{{0, 1}}, poses).ok());
    const core::Separation s = engine.narrow_phase->read_back().value().at(0);
    const Vec3 down = core::rotate(q, {0, -1, 0});  // from B to A
    seen.wrong += core::dot(s.normal, down) < std::cos(0.0175F) ? 1 : 0;
    seen.wrong_distance += std::abs(s.distance_m - gap_m) > 1e-4 ? 1 : 0;
  }
  seen.hits = engine.defects().at(0).hits;
  return seen;
}

core::Mesh small_box() {
  return datasets::box_mesh({0.5, 0.5, 0.5}, {1, 1, 1}).value();
}

TEST(BulletNearNormal, OfTurnedBoxesWithoutMarginIsWrongBelowAMillimeter) {
  const Seen seen = look(small_box(), "0", true, 4e-4);
  EXPECT_GT(seen.wrong, 20) << "mended upstream? then the row of vendor_defects.cpp goes";
  EXPECT_EQ(seen.wrong_distance, 0);
  EXPECT_GE(seen.hits, static_cast<std::uint64_t>(seen.wrong)) << "every wrong one is counted";
}

TEST(BulletNearNormal, OfBoxesThatAreNotTurnedIsRight) {
  const Seen seen = look(small_box(), "0", false, 4e-4);
  EXPECT_EQ(seen.wrong, 0);
  EXPECT_EQ(seen.hits, 0U);
}

TEST(BulletNearNormal, IsRightBeyondAMillimeterAndWithAMargin) {
  EXPECT_EQ(look(small_box(), "0", true, 2e-3).wrong, 0);
  EXPECT_EQ(look(small_box(), "bullet", true, 4e-4).wrong, 0);
}

TEST(BulletNearNormal, OfRoundBodiesIsRight) {
  EXPECT_EQ(look(datasets::sphere_mesh(0.25, 8).value(), "0", true, 4e-4).wrong, 0);
  // It lies along z.
  EXPECT_EQ(look(datasets::capsule_mesh(0.25, 0.125, 8).value(), "0", true, 4e-4).wrong, 0);
}

}  // namespace
}  // namespace broadside

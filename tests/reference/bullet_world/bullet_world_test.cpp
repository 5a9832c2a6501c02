// bullet-world against the discrete solution of its integrator and the laws of one contact. Expected values are worked
// out here; tolerances cover float's rounding over the steps that are named.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"
#include "reference/engines.hpp"

namespace broadside {
namespace {

using core::Vec3;

constexpr float kBulletStep_s = 1.0F / 64.0F;

std::shared_ptr<const core::Mesh> unit_cube() {
  return std::make_shared<const core::Mesh>(datasets::box_mesh({1.0, 1.0, 1.0}, {1, 1, 1}).value());
}

// Unit cubes of 1 kg in a domain of 20 m, without gravity, friction or bounce unless said otherwise.
core::Scene scene_of_cubes() {
  core::Scene scene;
  scene.name = "bullet";
  scene.meshes = {unit_cube()};
  scene.domain = {{-10, -10, -10}, {10, 10, 10}};
  scene.dt_s = kBulletStep_s;
  scene.face_material = {0.0F, 0.0F, 0.0F};
  return scene;
}

core::Body& add_cube(core::Scene& scene, Vec3 x, Vec3 v, core::Material material = {0.0F, 0.0F, 0.0F}) {
  core::Body body;
  body.position = x;
  body.velocity = v;
  body.material = material;
  scene.bodies.push_back(body);
  return scene.bodies.back();
}

core::Engine bullet_world_engine(const std::map<std::string, std::string>& given = {}) {
  const core::EngineRow row = reference::bullet_world_row();
  auto engine = row.create(core::Settings::parse(row.id, row.settings, given).value());
  EXPECT_TRUE(engine.ok());
  return std::move(engine).value();
}

std::vector<core::FrameRecord> bullet_frames(const core::Scene& scene, int steps,
                                             const std::map<std::string, std::string>& given = {}) {
  const core::Engine engine = bullet_world_engine(given);
  EXPECT_TRUE(engine.dynamics->load(scene).ok());
  std::vector<core::FrameRecord> frames;
  for (int k = 0; k < steps; ++k) {
    EXPECT_TRUE(engine.dynamics->step(scene.dt_s).ok());
    EXPECT_TRUE(engine.dynamics->read_back(frames.emplace_back(), core::RecordLevel::kFull).ok());
  }
  return frames;
}

TEST(BulletWorld, FreeFallIsSemiImplicitEuler) {
  core::Scene scene = scene_of_cubes();
  scene.gravity_m_s2 = {0, -8, 0};
  add_cube(scene, {0, 9, 0}, {1, 0, 0});
  const auto frames = bullet_frames(scene, 64);
  // After n steps v = n g dt and y = y0 + g dt^2 n (n + 1) / 2: all terms but the sum are powers of two.
  EXPECT_NEAR(frames.back().velocity[0].y, -8.0, 1e-5);
  EXPECT_NEAR(frames.back().velocity[0].x, 1.0, 1e-6);
  EXPECT_NEAR(frames.back().position[0].y, 9.0 - 8.0 * 64.0 * 65.0 / 2.0 / (64.0 * 64.0), 1e-4);
  EXPECT_EQ(frames.back().step, 64U);
  EXPECT_EQ(frames.back().time_s, 1.0);
}

TEST(BulletWorld, EqualCubesBounceWithTheLargerRestitution) {
  core::Scene scene = scene_of_cubes();
  add_cube(scene, {-1, 0, 0}, {2, 0, 0}, {0, 0, 0.25F});
  add_cube(scene, {1, 0, 0}, {-2, 0, 0}, {0, 0, 0.5F});
  const auto frames = bullet_frames(scene, 40);
  const Vec3 a = frames.back().velocity[0];
  const Vec3 b = frames.back().velocity[1];
  EXPECT_NEAR(a.x + b.x, 0.0, 1e-5) << "momentum";
  EXPECT_NEAR(b.x - a.x, 0.5 * 4.0, 1e-3) << "the larger restitution of the two";
  const auto with_products = bullet_frames(scene, 40, {{"combine", "bullet"}});
  EXPECT_NEAR(with_products.back().velocity[1].x - with_products.back().velocity[0].x, 0.125 * 4.0, 1e-3);
}

TEST(BulletWorld, HeavierBodiesKeepMoreOfTheirVelocity) {
  core::Scene scene = scene_of_cubes();
  add_cube(scene, {-1, 0, 0}, {1, 0, 0}).inverse_mass = 0.25F;
  add_cube(scene, {1, 0, 0}, {-1, 0, 0});
  const auto frames = bullet_frames(scene, 60);
  // No bounce: both go on with the center of mass, (4 - 1) / 5.
  EXPECT_NEAR(frames.back().velocity[0].x, 0.6, 1e-3);
  EXPECT_NEAR(frames.back().velocity[1].x, 0.6, 1e-3);
}

TEST(BulletWorld, ContactsPointFromBToAAndCarryTheWeight) {
  core::Scene scene = scene_of_cubes();
  scene.gravity_m_s2 = {0, -8, 0};
  add_cube(scene, {0, -9.5F, 0}, {}).inverse_mass = 0.5F;  // on the floor, 2 kg
  add_cube(scene, {0, -8.5F, 0}, {});                      // on the first, 1 kg
  const auto frames = bullet_frames(scene, 200);
  double on_pair = 0.0;
  double on_floor = 0.0;
  for (const core::Contact& c : frames.back().contacts) {
    EXPECT_NEAR(std::abs(c.normal.y), 1.0, 1e-4);
    if (core::is_face(c.b)) {
      EXPECT_EQ(c.a, 0U);
      EXPECT_EQ(c.b, core::kFirstFace + 2) << "-y";
      EXPECT_NEAR(c.normal.y, 1.0, 1e-4) << "inward";
      on_floor += c.normal_impulse_n_s;
    } else {
      EXPECT_EQ(c.a, 0U);
      EXPECT_EQ(c.b, 1U);
      EXPECT_NEAR(c.normal.y, -1.0, 1e-4) << "from B above to A below";
      on_pair += c.normal_impulse_n_s;
    }
    EXPECT_LT(std::abs(c.depth_m), 0.02);
  }
  EXPECT_NEAR(on_pair, 1.0 * 8.0 * kBulletStep_s, 0.02);
  EXPECT_NEAR(on_floor, 3.0 * 8.0 * kBulletStep_s, 0.03);
  EXPECT_NEAR(frames.back().position[0].y, -9.5, 0.02);
  EXPECT_EQ(frames.back().pairs, (std::vector<core::Pair>{{0, 1}}));
}

TEST(BulletWorld, SlidingFrictionTakesKineticFrictionTimesWeight) {
  core::Scene scene = scene_of_cubes();
  scene.gravity_m_s2 = {0, -8, 0};
  scene.face_material = {1.0F, 0.25F, 0.0F};
  add_cube(scene, {-8, -9.5F, 0}, {6, 0, 0}, {1.0F, 0.25F, 0.0F});
  const auto frames = bullet_frames(scene, 65);
  // The geometric mean of equal coefficients gives 0.25 * 8 m/s^2, over 64 steps after the first step has pressed the
  // cube onto the floor.
  EXPECT_NEAR(frames[64].velocity[0].x - frames[0].velocity[0].x, -2.0, 0.05);
  for (const core::Contact& c : frames.back().contacts) {
    EXPECT_LE(c.tangent_impulse_n_s, 0.0F);
    if (c.tangent_impulse_n_s < 0.0F) {
      EXPECT_NEAR(c.tangent.x, 1.0, 1e-3) << "against the impulse: along the sliding";
    }
  }
}

TEST(BulletWorld, BodiesTranslateUnlessTheSceneTurnsThem) {
  core::Scene scene = scene_of_cubes();
  add_cube(scene, {-1, 0, 0}, {2, 0, 0}, {0.5F, 0.5F, 0.0F});
  add_cube(scene, {1, 0.6F, 0.2F}, {-2, 0, 0}, {0.5F, 0.5F, 0.0F});
  const auto still = bullet_frames(scene, 60);
  EXPECT_EQ(still.back().orientation[0], core::Quat{});
  EXPECT_EQ(still.back().angular_velocity[0], Vec3{});
  EXPECT_NE(bullet_frames(scene, 60, {{"rotation", "on"}}).back().angular_velocity[0], Vec3{}) << "hit off center";

  core::Scene turning = scene_of_cubes();
  add_cube(turning, {0, 0, 0}, {}).angular_velocity = {0, 0, 1};
  const auto turned = bullet_frames(turning, 64);
  EXPECT_NEAR(turned.back().angular_velocity[0].z, 1.0, 1e-3) << "a cube about its axis keeps it";
  EXPECT_NEAR(2.0 * std::atan2(turned.back().orientation[0].z, turned.back().orientation[0].w), 1.0, 0.01);
}

TEST(BulletWorld, SameSceneSameBits) {
  core::Scene scene = scene_of_cubes();
  scene.gravity_m_s2 = {0, -8, 0};
  for (int k = 0; k < 12; ++k)
    add_cube(scene,
             {0.9F * static_cast<float>(k % 3), -9 + 1.1F * static_cast<float>(k / 3), 0.1F * static_cast<float>(k)},
             {}, {0.5F, 0.5F, 0.3F});
  const auto first = bullet_frames(scene, 90);
  const auto second = bullet_frames(scene, 90);
  for (std::size_t k = 0; k < first.size(); ++k) ASSERT_EQ(first[k].digest, second[k].digest) << "step " << k + 1;
  EXPECT_NE(first[88].digest, first[89].digest);
}

// A star-shaped body with concavities, the hull of it, and tetrahedra behind its triangles all end up on the floor.
TEST(BulletWorld, MeshesRestOnTheFloorInEveryForm) {
  core::Scene scene = scene_of_cubes();
  scene.gravity_m_s2 = {0, -8, 0};
  core::Mesh lumpy = datasets::lumpy_mesh(320, 5).value();
  const core::Box box = core::bounds(lumpy);
  scene.meshes = {std::make_shared<const core::Mesh>(std::move(lumpy))};
  add_cube(scene, {0, -10 - box.min.y + 0.2F, 0}, {});
  const auto word_of = [&](const char* mesh) {
    for (const core::EquivalenceFact& fact : bullet_world_engine({{"mesh", mesh}}).equivalence(scene))
      if (fact.property.starts_with("shape of")) return fact.engine;
    return std::string();
  };
  EXPECT_EQ(word_of("gimpact"), "GImpact triangle mesh");
  EXPECT_EQ(word_of("hull"), "hull of the vertices");
  EXPECT_NE(word_of("tetrahedra").find("320 tetrahedra"), std::string::npos);
  for (const char* mesh : {"gimpact", "hull", "tetrahedra"}) {
    const auto frames = bullet_frames(scene, 120, {{"mesh", mesh}});
    EXPECT_NEAR(frames.back().position[0].y + box.min.y, -10.0, 0.02) << mesh;
    EXPECT_NEAR(frames.back().velocity[0].y, 0.0, 0.5 * 8.0 * kBulletStep_s) << mesh << ": gravity gives 8 dt a step";
  }
}

TEST(BulletWorld, CardNamesWhatDiffersFromTheScene) {
  core::Scene scene = scene_of_cubes();
  scene.meshes.push_back(std::make_shared<const core::Mesh>(datasets::sphere_mesh(0.5, 8).value()));
  const core::EquivalenceCard card = bullet_world_engine().equivalence(scene);
  const auto fact = [&](std::string_view property) {
    for (const core::EquivalenceFact& f : card)
      if (f.property == property) return f;
    ADD_FAILURE() << "no " << property;
    return core::EquivalenceFact{};
  };
  EXPECT_EQ(fact("shape of box").engine, "box");
  EXPECT_FALSE(fact("shape of box").differs());
  EXPECT_EQ(fact("shape of sphere").engine, "sphere");
  EXPECT_TRUE(fact("shape of sphere").differs());
  EXPECT_FALSE(fact("friction rule").differs());
  EXPECT_TRUE(fact("solver iterations").differs());
  EXPECT_TRUE(fact("velocity cap").differs());
  EXPECT_NE(fact("library loaded").engine.find("libBulletCollision"), std::string::npos);
  for (const core::EquivalenceFact& f : bullet_world_engine({{"combine", "bullet"}}).equivalence(scene))
    if (f.property == "friction rule") {
      EXPECT_EQ(f.scene, "geometric mean");
    }
}

}  // namespace
}  // namespace broadside

// The tests that every engine that simulates must pass, whatever its solver. Every engine of the
// table is a subject; those with settings have lines in subjects().
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "core/engine/engine.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "reference/engines.hpp"
#include "tests/reference/subjects_of_the_table.hpp"

namespace broadside {
namespace {

using core::Vec3;

struct DynamicsSubject {
  std::string name;
  core::EngineRow (*row)();
  std::map<std::string, std::string> settings = {};
  // Moves by semi-implicit Euler to within float32's rounding, and records pairs and boxes. Other engines may move by
  // anything between that and explicit Euler, as every one-step method does, and record what they declare.
  bool is_method_like = false;
  std::size_t most_bodies = 100'000;  // more bodies need too much memory or time
};

void PrintTo(const DynamicsSubject& subject, std::ostream* out) {
  *out << subject.name;
}

std::vector<DynamicsSubject> dynamics_subjects() {
  std::vector<DynamicsSubject> all{
      {"octree_cpu", reference::octree_cpu_row, {}, true},
      {"octree_cpu_jacobi", reference::octree_cpu_row, {{"solver", "jacobi"}}, true},
      {"hash_cpu", reference::hash_cpu_row, {}, true},
      {"bullet_world", reference::bullet_world_row, {}, true},
      {"bullet_world_margin", reference::bullet_world_row, {{"margin", "bullet"}}, true},
      {"ode_world", reference::ode_world_row},
      {"ode_world_dantzig", reference::ode_world_row, {{"solver", "dantzig"}}},
      // Builds matrices of all contacts by all coordinates.
      {"mujoco_world", reference::mujoco_world_row, {}, false, 500},
      {"mujoco_world_rk4", reference::mujoco_world_row, {{"integrator", "rk4"}}, false, 500},
      // Builds a skeleton for each body.
      {"dart_world", reference::dart_world_row, {}, false, 1000},
  };
  all = tests::with_unlisted(all, "dynamics");
  // Simbody has no contact between a cube and another body; rigid_worlds_test has scenes that it supports.
  std::erase_if(all, [](const DynamicsSubject& s) {
    const core::EngineRow row = s.row();
    return s.name == "simbody_world" || (row.absent != nullptr && !row.absent().empty());
  });
  return all;
}

constexpr float kStep_s = 1.0F / 64.0F;

core::Scene scene_with_gravity() {
  core::Scene scene;
  scene.name = "dynamics";
  scene.meshes = {std::make_shared<const core::Mesh>(datasets::box_mesh({1.0, 1.0, 1.0}, {4, 4, 4}).value())};
  scene.domain = {{-8, -8, -8}, {8, 8, 8}};
  scene.gravity_m_s2 = {0, -8, 0};
  scene.dt_s = kStep_s;
  return scene;
}

core::Body& add_body(core::Scene& scene, Vec3 x, Vec3 v = {}) {
  core::Body body;
  body.position = x;
  body.velocity = v;
  scene.bodies.push_back(body);
  return scene.bodies.back();
}

class DynamicsEngines : public testing::TestWithParam<DynamicsSubject> {
 protected:
  [[nodiscard]] static core::Engine make() {
    const core::EngineRow row = GetParam().row();
    auto engine = row.create(core::Settings::parse(row.id, row.settings, GetParam().settings).value());
    EXPECT_TRUE(engine.ok());
    return std::move(engine).value();
  }

  core::FrameRecord run(const core::Scene& scene, int steps) {
    core::FrameRecord frame;
    const auto loaded = engine_.dynamics->load(scene);
    EXPECT_TRUE(loaded.ok()) << (loaded.ok() ? "" : loaded.error().line());
    for (int k = 0; k < steps; ++k) EXPECT_TRUE(engine_.dynamics->step(scene.dt_s).ok());
    EXPECT_TRUE(engine_.dynamics->read_back(frame, core::RecordLevel::kFull).ok());
    return frame;
  }

  [[nodiscard]] bool shows(core::Group group) const { return (engine_.dynamics->groups() & bit(group)) != 0; }
  [[nodiscard]] bool shows_pairs() const { return shows(core::Group::kPairs); }

  core::Engine engine_ = make();
};

TEST_P(DynamicsEngines, NamesItselfAndItsLibrary) {
  EXPECT_EQ(engine_.id, GetParam().row().id);
  EXPECT_NE(engine_.build.find_first_of("0123456789"), std::string::npos) << engine_.build;
}

TEST_P(DynamicsEngines, NoBodies) {
  const core::Scene scene = scene_with_gravity();
  const core::FrameRecord frame = run(scene, 3);
  EXPECT_EQ(frame.step, 3U);
  EXPECT_TRUE(frame.position.empty());
  EXPECT_TRUE(frame.contacts.empty());
}

// Of the integrator v' = v + g dt, x' = x + v' dt: after n steps v = n g dt and x = x0 + n v0 dt + g dt^2 n (n + 1)
// / 2.
TEST_P(DynamicsEngines, AFallingBodyFollowsTheDiscreteSolution) {
  core::Scene scene = scene_with_gravity();
  add_body(scene, {1, 7, 0}, {0.5F, 0, -1});
  const core::FrameRecord frame = run(scene, 32);
  EXPECT_NEAR(frame.velocity[0].y, -8.0 * 32.0 / 64.0, 1e-5);
  const double lowest = 7.0 - 8.0 * 32.0 * 33.0 / 2.0 / 4096.0;
  const double highest = GetParam().is_method_like ? lowest : 7.0 - 8.0 * 31.0 * 32.0 / 2.0 / 4096.0;
  EXPECT_GE(frame.position[0].y, lowest - 1e-4);
  EXPECT_LE(frame.position[0].y, highest + 1e-4);
  EXPECT_NEAR(frame.position[0].x, 1.25, 1e-4);
  EXPECT_NEAR(frame.position[0].z, -0.5, 1e-4);
}

TEST_P(DynamicsEngines, WhatItSaysToRecordIsThereInItsSize) {
  core::Scene scene = scene_with_gravity();
  add_body(scene, {0, -7.49F, 0});
  add_body(scene, {0, -6.5F, 0});
  add_body(scene, {4, 0, 0});
  const core::FrameRecord frame = run(scene, 8);
  ASSERT_TRUE(shows(core::Group::kBodies));
  if (GetParam().is_method_like) {
    ASSERT_TRUE(shows(core::Group::kDetection) && shows_pairs());
  }
  EXPECT_EQ(frame.position.size(), 3U);
  EXPECT_EQ(frame.orientation.size(), 3U);
  EXPECT_EQ(frame.velocity.size(), 3U);
  EXPECT_EQ(frame.angular_velocity.size(), 3U);
  EXPECT_EQ(frame.detected_position.size(), shows(core::Group::kDetection) ? 3U : 0U);
  EXPECT_EQ(frame.boxes.size(), shows(core::Group::kDetection) ? 3U : 0U);
  EXPECT_EQ(frame.detected_orientation.size(), shows(core::Group::kDetectedOrientation) ? 3U : 0U);
  EXPECT_EQ(frame.wide.position.size(), shows(core::Group::kWideBodies) ? 3U : 0U);
  EXPECT_EQ(frame.wide.angular_velocity.size(), shows(core::Group::kWideBodies) ? 3U : 0U);
  EXPECT_EQ(frame.pairs, shows_pairs() ? (std::vector<core::Pair>{{0, 1}}) : std::vector<core::Pair>{});
  if (shows_pairs()) {
    EXPECT_EQ(frame.pairs_demanded, 1U);
    EXPECT_GE(frame.pairs_raw, 1U);
  }
  EXPECT_EQ(frame.time_s, 8.0 / 64.0);
}

TEST_P(DynamicsEngines, TheFloorHoldsAndPushesInward) {
  core::Scene scene = scene_with_gravity();
  add_body(scene, {0, -7.4F, 0});
  const core::FrameRecord frame = run(scene, 128);
  EXPECT_NEAR(frame.position[0].y, -7.5, 0.02);
  EXPECT_LT(std::abs(frame.velocity[0].y), 8.0 * kStep_s);
  bool has_floor = false;
  for (const core::Contact& c : frame.contacts) {
    ASSERT_TRUE(core::is_face(c.b));
    has_floor = has_floor || c.b == core::kFirstFace + 2;
    EXPECT_NEAR(c.normal.y, 1.0, 1e-4);
  }
  for (const core::ContactPoint& p : frame.points) {
    ASSERT_TRUE(core::is_face(p.b));
    has_floor = has_floor || p.b == core::kFirstFace + 2;
    EXPECT_NEAR(p.normal.y, 1.0, 1e-4);
  }
  EXPECT_EQ(has_floor, shows(core::Group::kContacts) || shows(core::Group::kPoints));
}

TEST_P(DynamicsEngines, StaticBodiesStayWhereTheyAre) {
  core::Scene scene = scene_with_gravity();
  add_body(scene, {0, 0, 0}).inverse_mass = 0.0F;
  add_body(scene, {0.25F, 1.2F, 0});
  const core::FrameRecord frame = run(scene, 96);
  EXPECT_EQ(frame.position[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(frame.velocity[0], Vec3{});
  EXPECT_NEAR(frame.position[1].y, 1.0, 0.03) << "rests on the static one";
}

TEST_P(DynamicsEngines, MomentumOfTwoIsKept) {
  core::Scene scene = scene_with_gravity();
  scene.gravity_m_s2 = {};
  add_body(scene, {-1, 0, 0}, {1, 0.25F, 0});
  add_body(scene, {1, 0.1F, 0.2F}, {-2, 0, 0}).inverse_mass = 0.5F;
  const core::FrameRecord frame = run(scene, 48);
  const Vec3 momentum = frame.velocity[0] + 2.0F * frame.velocity[1];
  EXPECT_NEAR(momentum.x, 1.0 - 4.0, 1e-4);
  EXPECT_NEAR(momentum.y, 0.25, 1e-4);
  EXPECT_LT(frame.velocity[0].x, frame.velocity[1].x) << "they met and part";
}

// Cubes of 1 m whose faces just meet, at rest and without gravity: nothing may push them.
TEST_P(DynamicsEngines, TouchingBodiesAtRestStayAtRest) {
  core::Scene scene = scene_with_gravity();
  scene.gravity_m_s2 = {};
  add_body(scene, {-0.5F, 0, 0});
  add_body(scene, {0.5F, 0, 0});
  const core::FrameRecord frame = run(scene, 16);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(frame.position[k].x, k == 0 ? -0.5 : 0.5, 1e-4);
    EXPECT_NEAR(core::length(frame.velocity[k]), 0.0, 1e-4);
  }
}

// A small cube wholly inside a large one, off its center. Whatever an engine does with the two, states stay finite,
// momentum is kept, and the two are reported as a pair.
TEST_P(DynamicsEngines, AContainedBodyIsAPairAndStaysFinite) {
  core::Scene scene = scene_with_gravity();
  scene.gravity_m_s2 = {};
  scene.meshes.push_back(std::make_shared<const core::Mesh>(datasets::box_mesh({4.0, 4.0, 4.0}, {4, 4, 4}).value()));
  add_body(scene, {0.5F, 0.25F, 0});
  add_body(scene, {0, 0, 0}).mesh = 1;
  core::FrameRecord frame = run(scene, 1);
  EXPECT_EQ(frame.pairs, shows_pairs() ? (std::vector<core::Pair>{{0, 1}}) : std::vector<core::Pair>{});
  // An engine that corrects depth through velocities shoots the small one out, and it would meet the domain's faces.
  frame = run(scene, GetParam().is_method_like ? 32 : 4);
  Vec3 momentum{};
  for (int k = 0; k < 2; ++k) {
    momentum = momentum + frame.velocity[k];
    for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(std::isfinite(frame.position[k][axis]));
  }
  EXPECT_NEAR(core::length(momentum), 0.0, 1e-3);
}

TEST_P(DynamicsEngines, FarBodiesDoNotKnowOfEachOther) {
  core::Scene scene = scene_with_gravity();
  scene.domain = {{-4096, -4096, -4096}, {4096, 4096, 4096}};
  add_body(scene, {0, 0, 0}, {0.5F, 0, 0});
  const core::FrameRecord alone = run(scene, 24);
  add_body(scene, {2000, 2000, -2000}, {0, 0, 1});
  const core::FrameRecord two = run(scene, 24);
  EXPECT_EQ(two.position[0], alone.position[0]);
  EXPECT_EQ(two.velocity[0], alone.velocity[0]);
  EXPECT_TRUE(two.pairs.empty());
  EXPECT_TRUE(two.contacts.empty());
}

// Bodies that were moved or removed between two loads leave nothing behind.
TEST_P(DynamicsEngines, MovedAndRemovedBodiesLeaveNothingBehind) {
  core::Scene scene = scene_with_gravity();
  scene.gravity_m_s2 = {};
  add_body(scene, {0, 0, 0});
  add_body(scene, {0.9F, 0, 0});
  EXPECT_EQ(run(scene, 1).pairs.size(), shows_pairs() ? 1U : 0U);
  scene.bodies[1].position = {5, 0, 0};
  EXPECT_TRUE(run(scene, 1).pairs.empty());
  scene.bodies.pop_back();
  const core::FrameRecord frame = run(scene, 4);
  ASSERT_EQ(frame.position.size(), 1U);
  EXPECT_EQ(frame.position[0], Vec3{});
  EXPECT_TRUE(frame.pairs.empty());
}

// A lattice of 100,000 cubes, 2 m apart, in free fall: each follows the discrete solution, and none meets another.
TEST_P(DynamicsEngines, HundredThousandBodiesSlow) {
  constexpr int kSide = 47;  // 47^3 = 103,823
  constexpr std::size_t kBodies = 100'000;
  if (GetParam().most_bodies < kBodies) GTEST_SKIP() << "too many for its memory or its time";
  core::Scene scene = scene_with_gravity();
  scene.meshes = {std::make_shared<const core::Mesh>(datasets::box_mesh({1.0, 1.0, 1.0}, {1, 1, 1}).value())};
  scene.domain = {{-128, -128, -128}, {128, 128, 128}};
  for (int k = 0; scene.bodies.size() < kBodies; ++k)
    add_body(scene, {2.0F * static_cast<float>(k % kSide - kSide / 2),
                     2.0F * static_cast<float>(k / kSide % kSide - kSide / 2),
                     2.0F * static_cast<float>(k / kSide / kSide - kSide / 2)});
  const core::FrameRecord frame = run(scene, 3);
  ASSERT_EQ(frame.position.size(), kBodies);
  EXPECT_TRUE(frame.pairs.empty());
  for (std::size_t k = 0; k < kBodies; ++k) {
    ASSERT_NEAR(frame.velocity[k].y, -8.0 * 3.0 / 64.0, 1e-5) << k;
    const double fallen = scene.bodies[k].position.y - frame.position[k].y;
    ASSERT_LE(fallen, 8.0 * 3.0 * 4.0 / 2.0 / 4096.0 + 1e-4) << k;
    ASSERT_GE(fallen, 8.0 * 3.0 * (GetParam().is_method_like ? 4.0 : 2.0) / 2.0 / 4096.0 - 1e-4) << k;
    ASSERT_EQ(frame.position[k].x, scene.bodies[k].position.x) << k;
  }
}

TEST_P(DynamicsEngines, LoadStartsAfreshAndTheSameSceneGivesTheSameDigests) {
  core::Scene scene = scene_with_gravity();
  for (int k = 0; k < 8; ++k)
    add_body(scene, {0.3F * static_cast<float>(k % 2), -7.4F + 1.05F * static_cast<float>(k), 0});
  const std::uint64_t first = run(scene, 40).digest;
  EXPECT_EQ(run(scene, 40).digest, first) << "loaded again";
  const core::Engine other = make();
  ASSERT_TRUE(other.dynamics->load(scene).ok());
  for (int k = 0; k < 40; ++k) ASSERT_TRUE(other.dynamics->step(kStep_s).ok());
  core::FrameRecord frame;
  ASSERT_TRUE(other.dynamics->read_back(frame, core::RecordLevel::kDigest).ok());
  EXPECT_EQ(frame.digest, first) << "another engine, digest alone";
}

INSTANTIATE_TEST_SUITE_P(Reference, DynamicsEngines, testing::ValuesIn(dynamics_subjects()),
                         [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace broadside

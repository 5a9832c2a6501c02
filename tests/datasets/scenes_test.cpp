#include "datasets/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/scene/shapes.hpp"

namespace broadside {
namespace {

using core::Box;
using core::Scene;
using datasets::make_scene;
using datasets::SceneOptions;

Scene made(const std::string& spec, const SceneOptions& options = {}) {
  auto scene = make_scene(spec, options);
  EXPECT_TRUE(scene.ok()) << scene.error().line();
  return scene.ok() ? std::move(scene).value() : Scene{};
}

std::vector<Box> body_boxes(const Scene& scene) {
  std::vector<Box> boxes;
  for (const core::Body& body : scene.bodies)
    boxes.push_back(core::translated(core::bounds(*scene.meshes[body.mesh]), body.position));
  return boxes;
}

int overlaps(const std::vector<Box>& boxes) {
  int count = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j) count += core::overlaps(boxes[i], boxes[j]) ? 1 : 0;
  return count;
}

bool contains(const Box& outer, const Box& inner) {
  for (int k = 0; k < 3; ++k)
    if (inner.min[k] < outer.min[k] || inner.max[k] > outer.max[k]) return false;
  return true;
}

TEST(Freefall, IsTheSceneThatTheMethodFixes) {
  const Scene scene = made("freefall:lumpy:50");
  EXPECT_EQ(scene.name, "freefall:lumpy:50");
  ASSERT_EQ(scene.bodies.size(), 50U);
  EXPECT_EQ(scene.frames, 3000U);
  EXPECT_EQ(scene.dt_s, 1.0F / 60.0F);
  EXPECT_EQ(scene.gravity_m_s2, (core::Vec3{0.0F, -9.81F, 0.0F}));
  const Box body = core::bounds(*scene.meshes[0]);
  float longest = 0.0F;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, body.max[k] - body.min[k]);
  EXPECT_FLOAT_EQ(longest, 1.0F);
  // 4^3 is the first cube from 50: the grid is 4 x 1.1 m wide, the domain twice that.
  EXPECT_FLOAT_EQ(scene.domain.max.x - scene.domain.min.x, 8.8F);
  EXPECT_FLOAT_EQ(scene.domain.max.z - scene.domain.min.z, 8.8F);
  EXPECT_EQ(scene.domain.min.y, 0.0F);

  const std::vector<Box> boxes = body_boxes(scene);
  EXPECT_EQ(overlaps(boxes), 0);
  int lowest_layer = 0;
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    EXPECT_TRUE(contains(scene.domain, boxes[n])) << n;
    EXPECT_EQ(scene.bodies[n].inverse_mass, 1.0F);
    EXPECT_EQ(scene.bodies[n].velocity, core::Vec3{});
    // 1 m above the floor, shifted by at most 45 % of the 0.1 m gap.
    EXPECT_GE(boxes[n].min.y, 0.9549F);
    lowest_layer += boxes[n].min.y <= 1.0451F ? 1 : 0;
  }
  EXPECT_EQ(lowest_layer, 16);
}

TEST(Freefall, EveryCountFitsItsDomain) {
  for (const int n : {0, 1, 2, 8, 9, 27, 28}) {
    const Scene scene = made("freefall:cube:" + std::to_string(n));
    ASSERT_EQ(scene.bodies.size(), static_cast<std::size_t>(n));
    const auto boxes = body_boxes(scene);
    EXPECT_EQ(overlaps(boxes), 0) << n;
    for (const Box& box : boxes) EXPECT_TRUE(contains(scene.domain, box)) << n;
  }
}

TEST(Freefall, TheSeedAndTheFramesAreTheCallers) {
  SceneOptions options;
  options.seed = 7;
  options.frames = 12;
  const Scene seven = made("freefall:cube:20", options);
  EXPECT_EQ(seven.frames, 12U);
  EXPECT_EQ(seven.seed, 7U);
  EXPECT_EQ(core::scene_digest(seven), core::scene_digest(made("freefall:cube:20", options)));
  SceneOptions other = options;
  other.seed = 8;
  EXPECT_NE(core::scene_digest(seven), core::scene_digest(made("freefall:cube:20", other)));
}

// One fixed scene's digest: a scene that changes bits changes every golden answer downstream, so a change of generator
// must be seen and said in the change log. Recorded from the first release of this generator.
TEST(Freefall, ItsBitsStayTheSame) {
  EXPECT_EQ(core::scene_digest(made("freefall:cube:50")), 0x864f66afdec3ac42ULL);
  EXPECT_EQ(core::scene_digest(made("randommove:cube:50")), 0x4a8cf5d447e1d047ULL);
}

TEST(RandomMove, FillsAFifthOfACubeAndMovesAtUpToFiveMetersPerSecond) {
  for (const char* spec : {"randommove:cube:100", "randommove:lumpy:64", "randommove:cube:1", "randommove:sphere:2"}) {
    SCOPED_TRACE(spec);
    const Scene scene = made(spec);
    EXPECT_EQ(scene.gravity_m_s2, core::Vec3{});
    EXPECT_EQ(scene.face_material, (core::Material{0.0F, 0.0F, 1.0F}));
    const Box body = core::bounds(*scene.meshes[0]);
    double filled = static_cast<double>(scene.bodies.size());
    double volume = 1.0;
    for (int k = 0; k < 3; ++k) {
      filled *= body.max[k] - body.min[k];
      volume *= scene.domain.max[k] - scene.domain.min[k];
    }
    EXPECT_NEAR(filled / volume, 0.2, 1e-5);
    const auto boxes = body_boxes(scene);
    EXPECT_EQ(overlaps(boxes), 0);
    for (const Box& box : boxes) EXPECT_TRUE(contains(scene.domain, box));
    for (const core::Body& b : scene.bodies) EXPECT_LE(core::length(b.velocity), 5.0F);
  }
}

// Uniform speeds have mean 2.5 and variance 25/12, random directions have mean zero: each is held to five standard
// deviations of its mean over 4000 bodies.
TEST(RandomMove, SpeedsAndDirectionsAreUniform) {
  const Scene scene = made("randommove:cube:4000");
  double speed = 0.0;
  core::Vec3 direction;
  for (const core::Body& b : scene.bodies) {
    const float s = core::length(b.velocity);
    speed += s;
    direction = direction + (1.0F / s) * b.velocity;
  }
  EXPECT_NEAR(speed / 4000.0, 2.5, 5.0 * std::sqrt(25.0 / 12.0 / 4000.0));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(direction[k] / 4000.0F, 0.0, 5.0 * std::sqrt(1.0 / 3.0 / 4000.0));
}

TEST(SmallScenes, AreFewBodiesInsideTheirDomainThatVertexProximityCanSee) {
  for (const auto& row : datasets::scene_table()) {
    if (row.pattern != row.example) continue;
    SCOPED_TRACE(row.pattern);
    const Scene scene = made(std::string(row.example));
    EXPECT_EQ(scene.name, row.example);
    // Scenes whose bodies turn are no scenes of the method: tests/datasets/rigid_scenes_test.cpp looks at them.
    if (scene.motion == core::Motion::kRigid) continue;
    EXPECT_GE(scene.bodies.size(), 1U);
    // Many threads, so that a race would show.
    EXPECT_LE(scene.bodies.size(), scene.name == "errata:E8" ? 125U : 6U);
    EXPECT_LE(scene.frames, 300U);
    for (const Box& box : body_boxes(scene)) EXPECT_TRUE(contains(scene.domain, box));
    for (const auto& mesh : scene.meshes) {
      // Two lattices of square cells of side c that touch: no vertex is farther than c / sqrt 2 from one of the other.
      EXPECT_GT(core::mean_edge_m(*mesh), 0.125F / std::sqrt(2.0F));
    }
  }
}

TEST(Errata, E3HasUnequalMassesAndAStaticBody) {
  std::set<float> inverse_masses;
  for (const core::Body& b : made("errata:E3").bodies) inverse_masses.insert(b.inverse_mass);
  EXPECT_TRUE(inverse_masses.contains(0.0F));
  EXPECT_GE(inverse_masses.size(), 3U);
}

TEST(Errata, E4StartsInsideTheSlop) {
  const Scene scene = made("errata:E4");
  const auto boxes = body_boxes(scene);
  const float depth = boxes[2].max.y - boxes[3].min.y;
  EXPECT_GT(depth, 0.0F);
  EXPECT_LT(depth, scene.parameters.delta_m);
}

TEST(Scenes, EveryNameOfTheTableIsASceneAndNamesAreUnique) {
  SceneOptions options;
  options.meshes.allow_procedural = true;
  std::set<std::string_view> names;
  for (const auto& row : datasets::scene_table()) {
    EXPECT_TRUE(names.insert(row.pattern).second);
    if (row.example.find("dragon") != std::string_view::npos && options.meshes.mesh_dir.empty()) continue;
    EXPECT_TRUE(make_scene(std::string(row.example), options).ok()) << row.example;
  }
}

TEST(Scenes, EachBadNameIsOneClearLine) {
  const auto line = [](const std::string& spec) {
    const auto scene = make_scene(spec);
    EXPECT_FALSE(scene.ok()) << spec;
    if (scene.ok()) return std::string();
    EXPECT_EQ(scene.error().exit, core::Exit::kBadInput);
    EXPECT_EQ(scene.error().line().find('\n'), std::string::npos);
    return scene.error().line();
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(has(line("errata:E9"), "did you mean 'errata:E"));
  EXPECT_TRUE(has(line("frefall:bunny:50"), "did you mean 'freefall:bunny:50'?"));
  EXPECT_TRUE(has(line("freefall:buny:50"), "did you mean 'bunny'?"));
  EXPECT_TRUE(has(line("freefall:cube"), "freefall:MESH:N"));
  EXPECT_TRUE(has(line("freefall:cube:-1"), "whole number"));
  EXPECT_TRUE(has(line("freefall:cube:many"), "whole number"));
  EXPECT_TRUE(has(line("freefall:cube:99999999999"), "whole number"));
  EXPECT_TRUE(has(line(""), "no such scene"));
  EXPECT_TRUE(has(line("rigid:sphere:bounce"), "did you mean one like 'rigid:"));
  EXPECT_LT(line("rigid:sphere:bounce").size(), 250U) << "more names than a line holds are not listed";
}

}  // namespace
}  // namespace broadside

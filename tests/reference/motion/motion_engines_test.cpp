// Engines of continuous queries: each answers a plain case in our units and in our order of points, and declares which
// motions it can follow.
#include "reference/motion/motion_engines.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "datasets/shapes/box_mesh.hpp"

namespace broadside::reference {
namespace {

core::Result<core::MotionEngine> motion_engine(std::string_view id, const std::map<std::string, std::string>& given) {
  for (const core::MotionEngineRow& row : motion_engine_rows())
    if (row.id == id) return row.create(core::Settings::parse(row.id, row.settings, given).value());
  return core::Error{"no such engine"};
}

struct MotionSubject {
  std::string id;
  std::map<std::string, std::string> settings;
  double time_off = 1e-6;  // what its own tolerance or its float state allows, of the step
};

TEST(MotionEngines, AVertexAndTwoEdgesThatMeetHalfWay) {
  const continuous::MovingFeatures vertex{continuous::FeatureKind::kVertexFace,
                                          {{0.25, 0.25, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                          {{0.25, 0.25, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const continuous::MovingFeatures edges{continuous::FeatureKind::kEdgeEdge,
                                         {{0, 0, 0}, {1, 0, 0}, {0.5, -1, 1}, {0.5, 1, 1}},
                                         {{0, 0, 0}, {1, 0, 0}, {0.5, -1, -1}, {0.5, 1, -1}}};
  for (const MotionSubject& subject : std::vector<MotionSubject>{{"exact-motion", {}, 0.0},
                                                                 {"feature-impact", {}, 1e-12},
                                                                 {"fcl-features", {}},
                                                                 {"fcl-features", {{"root", "cubic"}}},
                                                                 {"fcl-features", {{"filter", "plane"}}}}) {
    auto engine = motion_engine(subject.id, subject.settings);
    ASSERT_TRUE(engine.ok());
    for (const auto& features : {vertex, edges}) {
      const auto found = engine.value().features->first_touch(features);
      ASSERT_TRUE(found.ok()) << subject.id;
      EXPECT_TRUE(found.value().touches) << subject.id;
      EXPECT_NEAR(found.value().time, 0.5, subject.time_off) << subject.id;
    }
  }
}

TEST(MotionEngines, ABoxThatFallsOnABox) {
  const std::vector<std::shared_ptr<const core::Mesh>> meshes{
      std::make_shared<const core::Mesh>(datasets::box_mesh({1, 1, 1}, {1, 1, 1}).value())};
  const core::MovingBody falls{0, {{{0.25F, 3, 0.125F}, {}}, {0, -4, 0}, {}}};
  const core::MovingBody stands{0, {}};
  for (const MotionSubject& subject : std::vector<MotionSubject>{
           {"exact-motion", {}},
           {"fcl-motion", {}, 1e-4},  // its toc_err
           {"fcl-motion", {{"gjk", "indep"}}, 1e-4},
           {"fcl-motion", {{"motion", "translation"}}, 1e-4},
           {"fcl-motion", {{"samples", "2001"}, {"solver", "naive"}}, 1e-3},  // two samples
           {"fcl-motion", {{"motion", "spline"}, {"samples", "2001"}, {"solver", "naive"}}, 1e-3},
           {"fcl-motion", {{"samples", "2001"}, {"shape", "mesh"}, {"solver", "naive"}}, 1e-3},
           {"bullet-cast", {}, 1e-4},  // float, and its own tolerance of 1e-4 m
           {"bullet-cast", {{"method", "subsimplex"}}, 1e-3}}) {
    auto engine = motion_engine(subject.id, subject.settings);
    ASSERT_TRUE(engine.ok()) << engine.error().line();
    ASSERT_TRUE(engine.value().bodies->load(meshes).ok()) << subject.id;
    const auto found = engine.value().bodies->first_touch(falls, stands);
    ASSERT_TRUE(found.ok()) << subject.id << ": " << found.error().line();
    EXPECT_TRUE(found.value().touches) << subject.id << " " << subject.settings.size();
    EXPECT_NEAR(found.value().time, 0.5, subject.time_off) << subject.id;
  }
}

// Known defects of FCL 0.7.0 (reference/README.md). If one is fixed some day, remove its row there.
TEST(MotionEngines, FclsMeshesPassThroughEachOther) {
  const std::vector<std::shared_ptr<const core::Mesh>> meshes{
      std::make_shared<const core::Mesh>(datasets::box_mesh({1, 1, 1}, {1, 1, 1}).value())};
  for (const std::map<std::string, std::string>& settings : std::vector<std::map<std::string, std::string>>{
           {{"shape", "mesh"}}, {{"motion", "translation"}, {"shape", "mesh"}, {"solver", "polynomial"}}}) {
    auto engine = motion_engine("fcl-motion", settings);
    ASSERT_TRUE(engine.value().bodies->load(meshes).ok());
    const auto found = engine.value().bodies->first_touch({0, {{{0.25F, 3, 0.125F}, {}}, {0, -4, 0}, {}}}, {0, {}});
    ASSERT_TRUE(found.ok());
    EXPECT_FALSE(found.value().touches);
  }
}

TEST(MotionEngines, WhichPathsTheyFollow) {
  const exact::RigidMotion straight{{}, {1, 0, 0}, {}};
  const exact::RigidMotion spins{{}, {}, {0, 1, 0}};
  const exact::RigidMotion tumbles{{}, {1, 0, 0}, {0, 1, 0}};
  const auto follows = [&](const char* id, const std::map<std::string, std::string>& settings) {
    const auto engine = motion_engine(id, settings);
    const core::BodyMotionQuery& bodies = *engine.value().bodies;
    return std::vector<bool>{bodies.follows(straight), bodies.follows(spins), bodies.follows(tumbles)};
  };
  EXPECT_EQ(follows("exact-motion", {}), (std::vector<bool>{true, true, true}));
  EXPECT_EQ(follows("fcl-motion", {}), (std::vector<bool>{true, true, true}));
  EXPECT_EQ(follows("fcl-motion", {{"motion", "translation"}}), (std::vector<bool>{true, false, false}));
  EXPECT_EQ(follows("fcl-motion", {{"motion", "screw"}}), (std::vector<bool>{true, true, false}));
  EXPECT_EQ(follows("bullet-cast", {}), (std::vector<bool>{true, true, true}));
  EXPECT_EQ(follows("bullet-cast", {{"method", "gjk"}}), (std::vector<bool>{true, false, false}));
}

TEST(MotionEngines, SettingsThatDoNotFitAreRefused) {
  EXPECT_FALSE(motion_engine("fcl-motion", {{"solver", "polynomial"}}).ok());
  EXPECT_FALSE(motion_engine("fcl-motion", {{"solver", "naive"}, {"samples", "1"}}).ok());
}

}  // namespace
}  // namespace broadside::reference

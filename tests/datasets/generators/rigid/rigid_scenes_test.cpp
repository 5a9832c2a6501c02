// The scenes with a known outcome: each is made, is sound, says how it ends, and survives a scene file.
#include "datasets/generators/rigid/rigid_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "datasets/circle.hpp"
#include "datasets/scene_file/scene_file.hpp"
#include "datasets/scenes.hpp"
#include "tests/datasets/temporary_folder.hpp"
#include "validation/mechanics/scene_answer.hpp"

namespace broadside::tests {
namespace {

TEST(RigidScenes, EachIsSoundAndItsAnswerIsKnown) {
  std::set<std::string_view> names;
  for (const datasets::SmallSceneRow& row : datasets::rigid_scenes()) {
    SCOPED_TRACE(row.name);
    EXPECT_TRUE(row.name.starts_with("rigid:"));
    EXPECT_TRUE(names.insert(row.name).second);
    const auto scene = datasets::make_scene(std::string(row.name));
    ASSERT_TRUE(scene.ok()) << scene.error().line();
    EXPECT_EQ(scene.value().motion, core::Motion::kRigid);
    EXPECT_NE(validation::find_answer(scene.value().answer), nullptr) << scene.value().answer;
    EXPECT_TRUE(core::hull_notes(scene.value()).empty());
  }
  EXPECT_GE(names.size(), 50U);
}

TEST(RigidScenes, ComeBackFromAFileWithTheirWrenchesAndAnswers) {
  const TemporaryFolder folder;
  for (const char* name : {"rigid:spin-up", "rigid:flight:pushed", "rigid:card-tent:stands", "rigid:disk:euler"}) {
    SCOPED_TRACE(name);
    const core::Scene scene = datasets::make_scene(name).value();
    const auto path = folder.path() / "written.toml";
    const auto written = datasets::write_scene_file(scene, path);
    ASSERT_TRUE(written.ok()) << written.error().line();
    const core::Scene again = datasets::make_scene(path.string()).value();
    EXPECT_EQ(core::scene_digest(again), core::scene_digest(scene));
    EXPECT_EQ(again.answer, scene.answer);
    EXPECT_EQ(again.wrenches, scene.wrenches);
  }
}

TEST(RigidScenes, AnotherStepKeepsTheEndTime) {
  const core::Scene scene = datasets::make_scene("rigid:bounce[dt_s=0.01]").value();
  EXPECT_FLOAT_EQ(scene.dt_s, 0.01F);
  EXPECT_EQ(scene.frames, 400U);
  EXPECT_EQ(datasets::make_scene("rigid:bounce[dt_s=0.01,frames=7]").value().frames, 7U);
  EXPECT_FALSE(datasets::make_scene("rigid:bounce[dt_s=0]").ok());
}

// Scenes compute directions by a series of our own: cosines and sines must agree with the library's to the last digits.
TEST(Circle, CosinesAndSinesAreThose) {
  for (int k = -100; k <= 100; ++k) {
    const double angle = 3.14 * k / 100.0;
    EXPECT_NEAR(datasets::turn_by(angle).cosine, std::cos(angle), 1e-15);
    EXPECT_NEAR(datasets::turn_by(angle).sine, std::sin(angle), 1e-15);
  }
  EXPECT_EQ(datasets::part_of_circle(3, 12).cosine, 0.0);
  EXPECT_EQ(datasets::part_of_circle(6, 12).cosine, -1.0);
  EXPECT_NEAR(datasets::part_of_circle(5, 16).sine, std::sin(5.0 * 3.14159265358979323846 / 8.0), 1e-15);
}

}  // namespace
}  // namespace broadside::tests

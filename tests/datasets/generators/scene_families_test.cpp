// Every family of scenes: any count, model, size and seed; sound starts; what the twin computes for it; and the way to
// a file and back.
#include "datasets/generators/scene_families.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/shapes.hpp"
#include "datasets/scene_file/scene_file.hpp"
#include "datasets/scenes.hpp"
#include "tests/datasets/temporary_folder.hpp"
#include "tests/datasets/twin_run.hpp"

namespace broadside {
namespace {

using core::Box;
using core::Scene;
using datasets::make_scene;

Scene family_scene(const std::string& spec) {
  auto scene = make_scene(spec);
  EXPECT_TRUE(scene.ok()) << scene.error().line();
  return scene.ok() ? std::move(scene).value() : Scene{};
}

std::vector<Box> leaf_boxes(const Scene& scene) {
  std::vector<Box> boxes;
  for (const core::Body& body : scene.bodies)
    boxes.push_back(core::translated(core::bounds(*scene.meshes[body.mesh]), body.position));
  return boxes;
}

// The smallest overlap over the axes, in m; negative when they are apart.
float depth(const Box& a, const Box& b) {
  float least = 1e30F;
  for (int k = 0; k < 3; ++k) least = std::min(least, std::min(a.max[k], b.max[k]) - std::max(a.min[k], b.min[k]));
  return least;
}

class Family : public testing::TestWithParam<std::string_view> {
 protected:
  static std::string name(const std::string& mesh, int count, const std::string& options = "") {
    return std::string(GetParam()) + ":" + mesh + ":" + std::to_string(count) + options;
  }
};

// Bodies stand on each other within rounding: coordinates up to 64 m in float are 2^-18 apart.
TEST_P(Family, EveryCountStartsInItsDomainWithoutOverlap) {
  for (const int count : {0, 1, 2, 7, 40}) {
    SCOPED_TRACE(count);
    const Scene scene = family_scene(name("brick", count));
    const std::vector<Box> boxes = leaf_boxes(scene);
    int moving = 0;
    for (const core::Body& body : scene.bodies) moving += body.inverse_mass > 0.0F ? 1 : 0;
    const bool is_static = GetParam() == "static";
    EXPECT_EQ(moving, is_static ? 0 : count + (GetParam() == "wall" ? 1 : 0));
    if (is_static) {
      EXPECT_EQ(boxes.size(), static_cast<std::size_t>(count));
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(boxes[i].min[k], scene.domain.min[k] - 0x1p-17F) << i;
        EXPECT_LE(boxes[i].max[k], scene.domain.max[k] + 0x1p-17F) << i;
      }
      if (is_static || GetParam() == "same-point") continue;
      for (std::size_t j = i + 1; j < boxes.size(); ++j)
        if (scene.bodies[i].inverse_mass > 0.0F || scene.bodies[j].inverse_mass > 0.0F) {
          EXPECT_LE(depth(boxes[i], boxes[j]), 0x1p-17F) << i << " " << j;
        }
    }
  }
}

TEST_P(Family, TakesModelSizeFramesAndSeed) {
  const Scene scene = family_scene(name("sphere", 12, "[longest_side_m=0.5,frames=17,seed=9]"));
  EXPECT_EQ(scene.frames, 17U);
  EXPECT_EQ(scene.seed, 9U);
  EXPECT_EQ(scene.name, name("sphere", 12, "[longest_side_m=0.5,frames=17,seed=9]"));
  if (GetParam() != "mixed-sizes") {
    const Box model = core::bounds(*scene.meshes[0]);
    const core::Vec3 sides = model.max - model.min;
    EXPECT_NEAR(std::max({sides.x, sides.y, sides.z}), 0.5F, 1e-6F);
  }
  EXPECT_EQ(core::scene_digest(scene), core::scene_digest(family_scene(scene.name)));
}

// The same bodies may turn; an engine whose bodies do not turn learns it from the scene's motion.
TEST_P(Family, MayTurn) {
  const Scene still = family_scene(name("cube", 12));
  const Scene turning = family_scene(name("cube", 12, "[rigid=1]"));
  EXPECT_EQ(still.motion, core::Motion::kTranslate);
  EXPECT_EQ(turning.motion, core::Motion::kRigid);
  EXPECT_NE(core::scene_digest(still), core::scene_digest(turning));
  EXPECT_EQ(core::scene_digest(still), core::scene_digest(family_scene(name("cube", 12, "[rigid=0]"))));
}

// No verdict of the sound pipeline may fail; the limits of the method show only in the motion.
TEST_P(Family, TheTwinRunsItAndNoVerdictFails) {
  Scene scene = family_scene(name("cube", 12));
  scene.frames = 60;
  for (const core::Verdict& v : tests::verdicts_of(scene)) {
    // Bodies that start in one place are moved apart by up to a side in one step, some of them through others, and the
    // law is right to report it.
    const bool is_true_finding = GetParam() == "same-point" && v.validator == "passage";
    EXPECT_EQ(v.outcome == core::Outcome::kFail, is_true_finding) << v.validator << ": " << v.explanation;
  }
}

TEST_P(Family, ComesBackFromAFileAsTheSameScene) {
  const tests::TemporaryFolder folder;
  const Scene scene = family_scene(name("brick", 9, "[seed=3]"));
  const core::Status written = datasets::write_scene_file(scene, folder.path() / "s.toml");
  ASSERT_TRUE(written.ok()) << written.error().line();
  EXPECT_EQ(core::scene_digest(family_scene((folder.path() / "s.toml").string())), core::scene_digest(scene));
}

// A scene file can name the same family as its generator, which sets bodies, parts, gravity and domain unless the file
// gives them.
TEST_P(Family, IsAGeneratorOfSceneFiles) {
  const tests::TemporaryFolder folder;
  const std::string common = "seed = 1\n[[mesh]]\nname = \"cube\"\ncatalogue = \"cube\"\nlongest_side_m = 1.0\n";
  const std::string generator = "[generator]\nkind = \"" + std::string(GetParam()) + "\"\ncount = 10\n";
  const Scene named = family_scene(name("cube", 10));
  const Scene from_file = family_scene(folder.file("s.toml", common + generator).string());
  ASSERT_EQ(from_file.bodies.size(), named.bodies.size());
  for (std::size_t b = 0; b < named.bodies.size(); ++b) {
    EXPECT_EQ(from_file.bodies[b].position, named.bodies[b].position);
    EXPECT_EQ(from_file.bodies[b].velocity, named.bodies[b].velocity);
    EXPECT_EQ(from_file.bodies[b].inverse_mass, named.bodies[b].inverse_mass);
    EXPECT_EQ(from_file.bodies[b].material, named.bodies[b].material);
    EXPECT_EQ(from_file.meshes[from_file.bodies[b].mesh]->vertices, named.meshes[named.bodies[b].mesh]->vertices);
  }
  EXPECT_EQ(from_file.domain, named.domain);
  EXPECT_EQ(from_file.gravity_m_s2, named.gravity_m_s2);
  EXPECT_EQ(from_file.face_material, named.face_material);
  EXPECT_EQ(from_file.parameters.theta_m, named.parameters.theta_m);
  const Scene upward =
      family_scene(folder.file("u.toml", "gravity_m_s2 = [0.0, 1.0, 0.0]\n" + common + generator).string());
  EXPECT_EQ(upward.gravity_m_s2, (core::Vec3{0.0F, 1.0F, 0.0F}));
}

std::vector<std::string_view> family_names() {
  std::vector<std::string_view> names;
  for (const auto& family : datasets::scene_families())
    // The two scenes of the method have keys of their own in scene files, and tests of their own.
    if (family.name != "freefall" && family.name != "randommove") names.push_back(family.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, Family, testing::ValuesIn(family_names()), [](const auto& row) {
  std::string name(row.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

// Where bodies turn, laws of mechanics judge the motion too.
class TurningFamily : public testing::TestWithParam<std::string_view> {};

TEST_P(TurningFamily, TheTwinRunsItAndNoVerdictFails) {
  Scene scene = family_scene(std::string(GetParam()) + ":cube:12[rigid=1]");
  scene.frames = 60;
  int laws_that_tie_motion_to_forces = 0;
  for (const core::Verdict& v : tests::verdicts_of(scene)) {
    EXPECT_NE(v.outcome, core::Outcome::kFail) << v.validator << ": " << v.explanation;
    laws_that_tie_motion_to_forces += v.ties_motion_to_forces && v.outcome == core::Outcome::kPass ? 1 : 0;
  }
  EXPECT_GT(laws_that_tie_motion_to_forces, 0);
}

INSTANTIATE_TEST_SUITE_P(All, TurningFamily,
                         testing::Values("tower", "pyramid", "domino", "wall", "drum", "hopper", "freefall",
                                         "mixed-sizes"),
                         [](const auto& row) {
                           std::string name(row.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// The shipped examples are as their descriptions say.
TEST(SceneFiles, AreTheBuiltInsOfTheirNames) {
  int families = 0;
  for (const auto& entry : std::filesystem::directory_iterator(BROADSIDE_SOURCE_DIR "/datasets/scenes")) {
    if (entry.path().extension() != ".toml" || entry.path().stem() == "freefall_bunny_50") continue;  // needs a file
    SCOPED_TRACE(entry.path());
    const Scene from_file = family_scene(entry.path().string());
    const Scene built_in = family_scene(from_file.name);
    // The small scenes have no seed of their own.
    datasets::SceneOptions options;
    options.seed = built_in.seed;
    const auto same_seed = make_scene(entry.path().string(), options);
    ASSERT_TRUE(same_seed.ok());
    EXPECT_EQ(core::scene_digest(same_seed.value()), core::scene_digest(built_in));
    families += from_file.name.starts_with("errata") ? 0 : 1;
  }
  EXPECT_EQ(families, 11);  // all but freefall
}

TEST(Static, NothingMovesAndThereIsNoPair) {
  Scene scene = family_scene("static:cube:30");
  scene.frames = 20;
  for (const core::FrameRecord& frame : tests::run_twin(scene).frames) {
    EXPECT_TRUE(frame.pairs.empty());
    EXPECT_TRUE(frame.contacts.empty());
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) ASSERT_EQ(frame.position[b], scene.bodies[b].position);
  }
}

TEST(SamePoint, EveryPairIsFoundInTheFirstFrame) {
  Scene scene = family_scene("same-point:cube:8");
  scene.frames = 1;
  EXPECT_EQ(tests::run_twin(scene).frames[0].pairs.size(), 28U);
}

// The drum, the funnel and the bin hold what is inside them.
TEST(Drum, KeepsItsBodies) {
  Scene scene = family_scene("drum:cube:20");
  scene.frames = 240;
  const auto run = tests::run_twin(scene);
  float wall = 0.0F;
  for (const core::Body& body : scene.bodies)
    if (body.inverse_mass == 0.0F) wall = std::max(wall, core::length({body.position.x, body.position.y, 0.0F}));
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const core::Vec3 p = run.frames.back().position[b];
    EXPECT_LE(core::length({p.x, p.y, 0.0F}), wall) << b;
  }
}

TEST(Funnel, BodiesReachTheFloorOnlyThroughItsOpening) {
  Scene scene = family_scene("funnel:cube:20");
  scene.frames = 300;
  const auto run = tests::run_twin(scene);
  int through = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (scene.bodies[b].inverse_mass == 0.0F) continue;
    through += run.frames.back().position[b].y < 2.5F ? 1 : 0;
    // In the plane of the opening, 3 m up, a center is within the opening's half-width of 0.8 m less half a body.
    for (std::size_t k = 1; k < run.frames.size(); ++k) {
      const core::Vec3 p = run.frames[k].position[b];
      if (std::abs(p.y - 3.2F) > 0.15F) continue;
      EXPECT_LE(std::max(std::abs(p.x), std::abs(p.z)), 0.8F) << b << " in frame " << k;
    }
  }
  EXPECT_GT(through, 0);
}

TEST(SceneNames, EachBadOptionIsOneClearLine) {
  const auto line = [](const std::string& spec) {
    const auto scene = make_scene(spec);
    EXPECT_FALSE(scene.ok()) << spec;
    return scene.ok() ? std::string() : scene.error().line();
  };
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(has(line("tower:cube:5[ofset=0.1]"), "did you mean 'offset'?"));
  EXPECT_TRUE(has(line("tower:cube:5[offset=0.5]"), "give a number from 0 to 0.45"));
  EXPECT_TRUE(has(line("tower:cube:5[offset=nan]"), "give a number from"));
  EXPECT_TRUE(has(line("tower:cube:5[offset=0.1"), "NAME[key=value,key=value]"));
  EXPECT_TRUE(has(line("tower:cube:5[offset]"), "NAME[key=value,key=value]"));
  EXPECT_TRUE(has(line("tower:cube:5[seed=1,seed=2]"), "'seed' is given twice"));
  EXPECT_TRUE(has(line("tower:cube:5[seed=-1]"), "seed is '-1'"));
  EXPECT_TRUE(has(line("tower:absent.ply:5"), "no such mesh file"));
  EXPECT_TRUE(has(line("errata:E2[gap=1]"), "there is no option 'gap'"));
  EXPECT_TRUE(has(line("boxes:uniform:100"), "use 'broadside pairs boxes:uniform:100'"));
}

}  // namespace
}  // namespace broadside

#include "datasets/scene_file/scene_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "datasets/scenes.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace broadside {
namespace {

using core::Scene;
using datasets::make_scene;
using datasets::SceneOptions;
using tests::TemporaryFolder;

std::filesystem::path shipped(const char* name) {
  return std::filesystem::path(BROADSIDE_SOURCE_DIR) / "datasets" / "scenes" / name;
}

// One body on one procedural mesh; `rest` is put before it.
std::string scene_text(const std::string& top, const std::string& body = "position_m = [0, 0, 0]\n") {
  return top +
         "\n[domain]\nmin_m = [-4, -4, -4]\nmax_m = [4, 4, 4]\n[[mesh]]\nname = \"cube\"\nshape = \"box\"\n[[body]]\n" +
         body;
}

std::string error_line(const std::string& content) {
  const TemporaryFolder folder;
  const auto scene = make_scene(folder.file("s.toml", content).string());
  EXPECT_FALSE(scene.ok()) << content;
  if (scene.ok()) return "";
  EXPECT_EQ(scene.error().exit, core::Exit::kBadInput);
  const std::string line = scene.error().line();
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  return line;
}

Scene read(const std::string& content) {
  const TemporaryFolder folder;
  auto scene = make_scene(folder.file("s.toml", content).string());
  EXPECT_TRUE(scene.ok()) << scene.error().line();
  return scene.ok() ? std::move(scene).value() : Scene{};
}

void expect_same_scene(const char* file, const char* name) {
  const auto from_file = make_scene(shipped(file).string());
  const auto built_in = make_scene(name);
  ASSERT_TRUE(from_file.ok()) << from_file.error().line();
  ASSERT_TRUE(built_in.ok()) << built_in.error().line();
  EXPECT_EQ(core::scene_digest(from_file.value()), core::scene_digest(built_in.value()));
  EXPECT_EQ(from_file.value().name, built_in.value().name);
  EXPECT_EQ(from_file.value().description, built_in.value().description);
}

TEST(SceneFile, ShippedFilesAreTheBuiltInScenes) {
  for (const char* id : {"E2", "E3", "E4", "E5", "E6"})
    expect_same_scene((std::string("errata_") + id + ".toml").c_str(), (std::string("errata:") + id).c_str());
  expect_same_scene("randommove_cube_100.toml", "randommove:cube:100");
}

TEST(SceneFile, TheMainJobsFileIsTheBuiltInScene) {
  if (std::getenv("BROADSIDE_MESH_DIR") == nullptr) GTEST_SKIP() << "BROADSIDE_MESH_DIR is not set: no bunny to read";
  expect_same_scene("freefall_bunny_50.toml", "freefall:bunny:50");
}

TEST(SceneFile, ReadsEveryField) {
  const Scene scene = read(R"(
name = "all fields"
description = "one of each"
frames = 12
seed = 34
dt_s = 0.5
gravity_m_s2 = [1, -2, 3.5]
[domain]
min_m = [-1, -2, -3]
max_m = [4, 5, 6]
[parameters]
delta_m = 0.25
beta = 0.5
alpha = 0.75
v_threshold_m_s = 2
impulse_min_n_s = 3
v_max_m_s = 4
epsilon_m = 5
theta_m = 6
hash_cell_m = 7
[material]
mu_static = 0.5
mu_kinetic = 0.25
restitution = 1
[face_material]
mu_static = 0.125
mu_kinetic = 0.0625
restitution = 0
[[mesh]]
name = "a"
shape = "box"
sides_m = [2, 4, 8]
segments = [1, 2, 3]
longest_side_m = 1
[[mesh]]
name = "b"
shape = "sphere"
radius_m = 1
frequency = 1
scale = 0.5
[[body]]
mesh = "b"
position_m = [1, 2, 3]
orientation_wxyz = [0, 0.6, 0, -0.8]
velocity_m_s = [4, 5, 6]
angular_velocity_rad_s = [7, 8, 9]
mass_kg = 4
fast = true
[body.material]
mu_static = 0
mu_kinetic = 0
restitution = 0.5
[[body]]
mesh = "a"
position_m = [0, 0, 0]
static = true
)");
  EXPECT_EQ(scene.name, "all fields");
  EXPECT_EQ(scene.description, "one of each");
  EXPECT_EQ(scene.frames, 12U);
  EXPECT_EQ(scene.seed, 34U);
  EXPECT_EQ(scene.dt_s, 0.5F);
  EXPECT_EQ(scene.gravity_m_s2, (core::Vec3{1.0F, -2.0F, 3.5F}));
  EXPECT_EQ(scene.domain, (core::Box{{-1.0F, -2.0F, -3.0F}, {4.0F, 5.0F, 6.0F}}));
  const core::Parameters& p = scene.parameters;
  EXPECT_EQ(p.delta_m, 0.25F);
  EXPECT_EQ(p.beta, 0.5F);
  EXPECT_EQ(p.alpha, 0.75F);
  EXPECT_EQ(p.v_threshold_m_s, 2.0F);
  EXPECT_EQ(p.impulse_min_n_s, 3.0F);
  EXPECT_EQ(p.v_max_m_s, 4.0F);
  EXPECT_EQ(p.epsilon_m, 5.0F);
  EXPECT_EQ(p.theta_m, 6.0F);
  EXPECT_EQ(p.hash_cell_m, 7.0F);
  EXPECT_EQ(scene.face_material, (core::Material{0.125F, 0.0625F, 0.0F}));
  ASSERT_EQ(scene.meshes.size(), 2U);
  EXPECT_EQ(core::bounds(*scene.meshes[0]), (core::Box{{-0.125F, -0.25F, -0.5F}, {0.125F, 0.25F, 0.5F}}));
  EXPECT_EQ(scene.meshes[1]->vertices.size(), 12U);
  ASSERT_EQ(scene.bodies.size(), 2U);
  const core::Body& first = scene.bodies[0];
  EXPECT_EQ(first.mesh, 1U);
  EXPECT_EQ(first.position, (core::Vec3{1.0F, 2.0F, 3.0F}));
  EXPECT_EQ(first.orientation, (core::Quat{0.0F, 0.6F, 0.0F, -0.8F}));
  EXPECT_EQ(first.velocity, (core::Vec3{4.0F, 5.0F, 6.0F}));
  EXPECT_EQ(first.angular_velocity, (core::Vec3{7.0F, 8.0F, 9.0F}));
  EXPECT_EQ(first.inverse_mass, 0.25F);
  EXPECT_EQ(first.material, (core::Material{0.0F, 0.0F, 0.5F}));
  EXPECT_EQ(scene.is_fast, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_EQ(scene.bodies[1].inverse_mass, 0.0F);
  EXPECT_EQ(scene.bodies[1].material, (core::Material{0.5F, 0.25F, 1.0F}));
}

TEST(SceneFile, TheCallersFramesAndSeedComeFirst) {
  const TemporaryFolder folder;
  const auto path = folder.file("s.toml", scene_text("frames = 5\nseed = 6\n"));
  SceneOptions options;
  options.frames = 7;
  options.seed = 8;
  const auto scene = make_scene(path.string(), options);
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(scene.value().frames, 7U);
  EXPECT_EQ(scene.value().seed, 8U);
}

TEST(SceneFile, MeshFilesAreRelativeToTheSceneFile) {
  const TemporaryFolder folder;
  folder.file("t.off", "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const auto path = folder.file(
      "s.toml", "[domain]\nmin_m=[-4,-4,-4]\nmax_m=[4,4,4]\n[[mesh]]\nfile=\"t.off\"\n[[body]]\nposition_m=[0,0,0]\n");
  const auto scene = make_scene(path.string());
  ASSERT_TRUE(scene.ok()) << scene.error().line();
  EXPECT_EQ(scene.value().meshes[0]->vertices.size(), 4U);
  EXPECT_TRUE(scene.value().meshes[0]->source.starts_with("t.off sha256 "));
}

TEST(SceneFile, NoBodiesOneBodyAndBodiesAtOnePointAreScenes) {
  EXPECT_EQ(read("[domain]\nmin_m = [0, 0, 0]\nmax_m = [1, 1, 1]\n").bodies.size(), 0U);
  EXPECT_EQ(read(scene_text("")).bodies.size(), 1U);
  EXPECT_EQ(
      read(scene_text("", "position_m = [0,0,0]\n[[body]]\nposition_m = [0,0,0]\n[[body]]\nposition_m = [0,0,0]\n"))
          .bodies.size(),
      3U);
}

TEST(SceneFile, EachBadFileIsOneLineWithItsPlace) {
  const struct {
    std::string content;
    const char* place;
    const char* says;
  } cases[] = {
      {"name = ", "s.toml:1", ""},
      {"name = \"a\"\n[[[", "s.toml:2", ""},
      {scene_text("gravty_m_s2 = [0, 0, 0]"), "s.toml:1", "did you mean 'gravity_m_s2'?"},
      {scene_text("\nframes = 1.5"), "s.toml:2", "frames is a number; give a whole number"},
      {scene_text("frames = 0"), "s.toml:1", "frames is 0"},
      {scene_text("frames = -3"), "s.toml:1", "frames is -3"},
      {scene_text("seed = -1"), "s.toml:1", "seed is -1"},
      {scene_text("seed = \"12x\""), "s.toml:1", "seed is '12x'"},
      {scene_text("dt_s = nan"), "s.toml:1", "NaN or infinite"},
      {scene_text("dt_s = 0"), "s.toml:1", "zero"},
      {scene_text("dt_s = \"fast\""), "s.toml:1", "dt_s is a text"},
      {scene_text("gravity_m_s2 = [0, -inf, 0]"), "s.toml:1", "NaN or infinite"},
      {scene_text("gravity_m_s2 = [0, 1]"), "s.toml:1", "2 entries"},
      {scene_text("gravity_m_s2 = [0, 1e39, 0]"), "s.toml:1", "too large"},
      {scene_text("[parameters]\nbeta = 1.5"), "s.toml:1", "beta is out of range"},
      {scene_text("[parameters]\nbetta = 1"), "s.toml:2", "did you mean 'beta'?"},
      {scene_text("[face_material]\nrestitution = 2"), "s.toml:1", "restitution is outside 0 to 1"},
      {scene_text("", "mass_kg = 1\n"), "s.toml:8", "no position"},
      {scene_text("", "position_m = [0, nan, 0]\n"), "s.toml:9", "NaN or infinite"},
      {scene_text("", "position_m = [0, 0, 0]\nmass_kg = 0\n"), "s.toml:10", "zero or negative"},
      {scene_text("", "position_m = [0, 0, 0]\nmass_kg = -2.5\n"), "s.toml:10", "zero or negative"},
      {scene_text("", "position_m = [0, 0, 0]\nmass_kg = 1\nstatic = true\n"), "s.toml:10", "static body has a mass"},
      {scene_text("", "position_m = [0, 0, 0]\norientation_wxyz = [1, 1, 0, 0]\n"), "s.toml:10", "unit quaternion"},
      {scene_text("", "position_m = [0, 0, 0]\nmesh = \"cub\"\n"), "s.toml:10", "did you mean 'cube'?"},
      {scene_text("", "position_m = [0, 0, 0]\nvelocty_m_s = [0, 0, 0]\n"), "s.toml:10",
       "did you mean 'velocity_m_s'?"},
      {scene_text("", "position_m = [0, 0, 0]\nmaterial = { mu_static = 0.1, mu_kinetic = 0.2 }\n"), "s.toml:8",
       "mu_kinetic is above mu_static"},
      {"[[mesh]]\nshape = \"box\"\n", "s.toml:1", "no domain"},
      {"[domain]\nmin_m = [0, 0, 0]\n", "s.toml:1", "not complete"},
      {"\n[domain]\nmin_m = [1, 1, 1]\nmax_m = [0, 0, 0]\n", "s.toml:2", "no volume"},
      {"[[mesh]]\ncatalogue = \"buny\"\n", "s.toml:2", "did you mean 'bunny'?"},
      {"[[mesh]]\nfile = \"absent.ply\"\n", "s.toml:2", "no such mesh file"},
      {"[[mesh]]\nname = \"x\"\n", "s.toml:1", "exactly one of"},
      {"[[mesh]]\nshape = \"blob\"\n", "s.toml:2", "one of: box sphere capsule cylinder lumpy"},
      {"[[mesh]]\nshape = \"box\"\nradius_m = 1\n", "s.toml:3", "unknown key 'radius_m'"},
      {"[[mesh]]\nshape = \"box\"\nscale = 0\n", "s.toml:3", "zero or negative"},
      {"[[mesh]]\nshape = \"box\"\n[[mesh]]\nshape = \"box\"\n", "s.toml:3", "a second mesh"},
      {"[[mesh]]\nshape = \"box\"\n[generator]\nkind = \"stacked-grd\"\ncount = 1\n", "s.toml:4",
       "did you mean 'stacked-grid'?"},
      {"[[mesh]]\nshape = \"box\"\n[generator]\nkind = \"stacked-grid\"\n", "s.toml:3", "no count"},
      {"[[mesh]]\nshape = \"box\"\n[generator]\nkind = \"filled-cube\"\ncount = 5\nfill = 0.9\n", "s.toml:6",
       "above 0.5"},
      {"[generator]\nkind = \"stacked-grid\"\ncount = 5\n", "s.toml:1", "there is no [[mesh]]"},
      {"mesh = 3\n", "s.toml:1", "[[mesh]]"},
      {"mesh = [3]\n", "s.toml:1", "[[mesh]]"},
      {"domain = 3\n", "s.toml:1", "[domain]"},
  };
  for (const auto& bad : cases) {
    SCOPED_TRACE(bad.content);
    const std::string line = error_line(bad.content);
    EXPECT_NE(line.find(std::string(bad.place) + ":"), std::string::npos) << line;
    EXPECT_NE(line.find(bad.says), std::string::npos) << line;
  }
}

TEST(SceneFile, MissingFilesAndFoldersAreOneLine) {
  const TemporaryFolder folder;
  const auto absent = make_scene((folder.path() / "absent.toml").string());
  ASSERT_FALSE(absent.ok());
  EXPECT_NE(absent.error().line().find("no such scene file"), std::string::npos);
  std::filesystem::create_directory(folder.path() / "d.toml");
  const auto directory = make_scene((folder.path() / "d.toml").string());
  ASSERT_FALSE(directory.ok());
  EXPECT_NE(directory.error().line().find("not a file"), std::string::npos);
}

TEST(WriteSceneFile, ReadsBackToTheSameDigest) {
  const TemporaryFolder folder;
  for (const char* name : {"errata:E3", "springs:hanging", "errata:E6", "freefall:lumpy:20", "randommove:sphere:20"}) {
    SCOPED_TRACE(name);
    Scene scene = std::move(make_scene(name)).value();
    // What rounding through text would lose: a third, a denormal, a negative zero, a turned body, a large seed.
    scene.bodies[0].velocity = {1.0F / 3.0F, 1e-42F, -0.0F};
    scene.bodies[0].inverse_mass = 1.0F / 3.0F;
    scene.bodies[1].orientation = {std::sqrt(0.5F), 0.0F, -std::sqrt(0.5F), 0.0F};
    scene.bodies[1].material = {0.2F, 0.1F, 0.7F};
    scene.is_fast.assign(scene.bodies.size(), 0);
    scene.is_fast[1] = 1;
    scene.seed = 0xFFFFFFFFFFFFFFFEULL;
    scene.name = "quoted \"name\" \\ and\ttab";
    const auto path = folder.path() / "written.toml";
    const auto written = datasets::write_scene_file(scene, path);
    ASSERT_TRUE(written.ok()) << written.error().line();
    const auto again = make_scene(path.string());
    ASSERT_TRUE(again.ok()) << again.error().line();
    EXPECT_EQ(core::scene_digest(again.value()), core::scene_digest(scene));
    EXPECT_EQ(again.value().name, scene.name);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
}

TEST(WriteSceneFile, AnUnwritableFolderIsOneLineAndLeavesNothing) {
  const TemporaryFolder folder;
  const auto status =
      datasets::write_scene_file(make_scene("two-body:apart").value(), folder.path() / "absent" / "s.toml");
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().line().find("cannot be written"), std::string::npos) << status.error().line();
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace broadside

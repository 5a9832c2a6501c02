// Pictures of scenes: bodies that turn are drawn as they lie, and bodies that translate as before.
#include "bench/cli/scene_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>

#include "datasets/scenes.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::bench {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

core::Scene empty_scene() {
  core::Scene scene;
  scene.name = "picture";
  scene.motion = core::Motion::kRigid;
  scene.domain = {{-10, -10, -10}, {10, 10, 10}};
  return scene;
}

void add_body(core::Scene& scene, core::Result<core::Mesh> mesh, core::Vec3 position, core::Quat orientation = {}) {
  core::Body body;
  body.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  body.position = position;
  body.orientation = orientation;
  scene.meshes.push_back(std::make_shared<core::Mesh>(std::move(mesh).value()));
  scene.bodies.push_back(body);
}

core::Quat about_y(double degrees) {
  return {static_cast<float>(std::cos(0.5 * degrees * kRadians)), 0,
          static_cast<float>(std::sin(0.5 * degrees * kRadians)), 0};
}

std::string start_of(const core::Scene& scene) {
  ScenePanel panel{"start", {}, {}};
  for (const core::Body& body : scene.bodies) {
    panel.positions.push_back(body.position);
    panel.orientations.push_back(body.orientation);
  }
  return scene_svg(scene, std::span(&panel, 1));
}

// Width and height of the path that has this class, px.
struct Extent {
  double width = 0.0, height = 0.0;
};

Extent extent_of(const std::string& svg, const std::string& style) {
  const std::size_t at = svg.find("class=\"" + style + "\" d=\"");
  if (at == std::string::npos) return {};
  const std::size_t from = svg.find("d=\"", at) + 3;
  const std::string data = svg.substr(from, svg.find('"', from) - from);
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  const std::regex point("[ML](-?[0-9.]+) (-?[0-9.]+)");
  for (std::sregex_iterator p(data.begin(), data.end(), point), end; p != end; ++p) {
    const double x = std::stod((*p)[1]), y = std::stod((*p)[2]);
    left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
  }
  return {right - left, bottom - top};
}

// The view direction is 28 degrees from z toward x, around the vertical axis, and a positive turn about y goes the same
// way. So a unit cube that is turned by a is |cos(28 - a)| + |sin(28 - a)| wide. Pixels are rounded to tenths.
TEST(ScenePicture, ACubeThatIsTurnedHasTheOutlineOfItsPose) {
  core::Scene scene = empty_scene();
  add_body(scene, datasets::box_mesh({1, 1, 1}, {1, 1, 1}), {-1.5F, 0, 0});
  add_body(scene, datasets::box_mesh({1, 1, 1}, {1, 1, 1}), {1.5F, 0, 0}, about_y(31.0));
  const std::string svg = start_of(scene);
  const auto width = [](double a) { return std::abs(std::cos(a * kRadians)) + std::abs(std::sin(a * kRadians)); };
  const double upright = extent_of(svg, "s0").width;
  ASSERT_GT(upright, 40.0);
  EXPECT_NEAR(extent_of(svg, "s1").width / upright, width(28.0 - 31.0) / width(28.0), 0.4 / upright);
}

TEST(ScenePicture, ABallIsRoundHoweverItIsTurned) {
  core::Scene scene = empty_scene();
  add_body(scene, datasets::sphere_mesh(0.5, 4), {0, 0, 0}, about_y(17.0));
  add_body(scene, datasets::box_mesh({1, 1, 1}, {1, 1, 1}), {1.5F, 0, 0});
  const Extent ball = extent_of(start_of(scene), "s0");
  ASSERT_GT(ball.width, 40.0);
  EXPECT_NEAR(ball.width / ball.height, 1.0, 0.03);
}

// The plank's center is nearer to the eye than the cube's, which stands on its far end.
TEST(ScenePicture, WhatHidesAnotherIsPaintedAfterIt) {
  core::Scene scene = empty_scene();
  add_body(scene, datasets::box_mesh({1, 1, 1}, {1, 1, 1}), {0, 0.6F, -3.5F});
  add_body(scene, datasets::box_mesh({1, 0.2, 8}, {1, 1, 1}), {0, 0, 0});
  const std::string svg = start_of(scene);
  const std::size_t cube = svg.find("class=\"s0\""), plank = svg.find("class=\"s1\"");
  ASSERT_NE(cube, std::string::npos);
  ASSERT_NE(plank, std::string::npos);
  EXPECT_LT(plank, cube);
}

TEST(ScenePicture, AMeshThatIsNotConvexIsDrawnAsItself) {
  auto scene = datasets::make_scene("freefall:lumpy:1[rigid=1]", {});
  ASSERT_TRUE(scene) << scene.error().line();
  const std::string svg = start_of(scene.value());
  EXPECT_NE(svg.find("v1.2h-"), std::string::npos) << "rows of pixels, not a polygon";
}

// The picture that the page of data sets shows, made by the program of today.
TEST(ScenePicture, BodiesThatTranslateAreDrawnAsTheyWere) {
  const tests::ScratchFolder folder;
  const tests::Ended ended =
      tests::run_program({"scene", "tower:cube:10", "--picture", (folder / "tower.svg").string(), "--after", "300"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  // What comes after the colors, which are those of all plots.
  const auto shapes = [](const std::string& svg) { return svg.substr(std::min(svg.find("</style>"), svg.size())); };
  const std::string kept =
      shapes(tests::read_text(std::filesystem::path(BROADSIDE_SOURCE_DIR) / "datasets/pictures/tower.svg"));
  ASSERT_FALSE(kept.empty());
  EXPECT_TRUE(shapes(tests::read_text(folder / "tower.svg")) == kept);
}

}  // namespace
}  // namespace broadside::bench

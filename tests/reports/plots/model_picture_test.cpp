// Pictures of a model with boxes: where things land on the picture follows from geometry.
#include "reports/plots/model_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "core/math/box.hpp"
#include "reports/plots/shaded_model.hpp"
#include "tests/reports/markup_checker.hpp"

namespace broadside::reports::plots {
namespace {

using core::Box;
using core::Mesh;
using core::Vec3;

// A unit square facing +z at depth z.
void add_square(Mesh& mesh, float z, float half) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3 corner : {Vec3{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}})
    mesh.vertices.push_back(corner);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

TEST(Projection, LooksAlongMinusZAtAzimuthZero) {
  const Projected p = project({1.0F, 2.0F, 3.0F}, {0.0, 0.0});
  EXPECT_DOUBLE_EQ(p.x, 1.0);
  EXPECT_DOUBLE_EQ(p.y, 2.0);
  EXPECT_DOUBLE_EQ(p.toward_eye, 3.0);
}

TEST(Projection, TurnsAndKeepsLengths) {
  const Projected right = project({1.0F, 0.0F, 0.0F}, {90.0, 0.0});
  EXPECT_NEAR(right.toward_eye, 1.0, 1e-12) << "from +x, the x axis points to the eye";
  const Projected above = project({0.0F, 1.0F, 0.0F}, {0.0, 90.0});
  EXPECT_NEAR(above.toward_eye, 1.0, 1e-12) << "from above, the y axis points to the eye";
  const Projected p = project({0.3F, -0.7F, 1.1F}, {37.0, 21.0});
  EXPECT_NEAR(p.x * p.x + p.y * p.y + p.toward_eye * p.toward_eye, 0.09 + 0.49 + 1.21, 1e-6);
}

TEST(ShadedModel, ASquareCoversItsShareOfTheWindow) {
  Mesh mesh;
  add_square(mesh, 0.0F, 0.5F);
  const Raster raster = shade_model(mesh, {0.0, 0.0}, {-1.0, 1.0, 2.0}, 40);
  int covered = 0;
  for (const float b : raster.brightness) covered += b >= 0.0F ? 1 : 0;
  EXPECT_EQ(covered, 20 * 20);
  EXPECT_LT(raster.brightness[0], 0.0F);
}

TEST(ShadedModel, TheNearerSurfaceIsSeen) {
  Mesh near_first;
  add_square(near_first, 1.0F, 0.5F);
  Mesh tilted = near_first;
  // Behind it, a square that faces elsewhere and is therefore darker.
  tilted.vertices.insert(tilted.vertices.end(), {{-0.9F, -0.9F, -1.0F}, {0.9F, -0.9F, -9.0F}, {0.9F, 0.9F, -9.0F}});
  tilted.triangles.push_back({4, 5, 6});
  const Window window{-1.0, 1.0, 2.0};
  const Raster alone = shade_model(near_first, {0.0, 0.0}, window, 40);
  const Raster both = shade_model(tilted, {0.0, 0.0}, window, 40);
  const std::size_t middle = 20 * 40 + 20;
  EXPECT_FLOAT_EQ(alone.brightness[middle], both.brightness[middle]);
  const std::size_t outside = 20 * 40 + 36;
  EXPECT_LT(alone.brightness[outside], 0.0F);
  EXPECT_GE(both.brightness[outside], 0.0F);
}

TEST(ModelPicture, EveryBoxHasTwelveEdgesAndThreeAreBehind) {
  Mesh mesh;
  add_square(mesh, 0.0F, 0.5F);
  const std::vector<Box> boxes{{{-1, -1, -1}, {1, 1, 1}}, core::empty_box(), {{0, 0, 0}, {1, 1, 1}}};
  const std::string picture = svg(ModelPicture{"bunny <level 1>", "two boxes", {}}, mesh, boxes);
  const auto markup = testing_markup::check_markup(picture, false);
  ASSERT_EQ(markup.problem, "");
  std::size_t before = 0;
  std::size_t behind = 0;
  for (const auto& e : markup.elements) {
    if (!e.attributes.contains("class")) continue;
    const std::string& style = e.attributes.at("class");
    const std::string data = e.attributes.contains("d") ? e.attributes.at("d") : "";
    const auto edges = static_cast<std::size_t>(std::count(data.begin(), data.end(), 'M'));
    if (style == "model-box") before += edges;
    if (style == "model-box behind") behind += edges;
  }
  EXPECT_EQ(before, 18U);
  EXPECT_EQ(behind, 6U);
}

TEST(ModelPicture, AnEmptyMeshIsStillAPicture) {
  const std::string picture = svg(ModelPicture{"nothing", "nothing", {}}, Mesh{}, {});
  EXPECT_EQ(testing_markup::check_markup(picture, false).problem, "");
}

}  // namespace
}  // namespace broadside::reports::plots

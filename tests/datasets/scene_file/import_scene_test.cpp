// glTF scenes: places, rotations, scales, mirrors and instances, with what a body becomes worked out by hand.
#include "datasets/scene_file/import_scene.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/mesh/topology.hpp"
#include "datasets/scenes.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace broadside {
namespace {

using core::Scene;
using tests::TemporaryFolder;

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (int k = 3; k >= 0; --k) text += kDigits[group >> (6 * k) & 63U];
  }
  for (std::size_t k = 0; k < (3 - bytes.size() % 3) % 3; ++k) text[text.size() - 1 - k] = '=';
  return text;
}

// A tetrahedron with corners at the origin and 1, 2, 3 along the axes; `nodes` and the scene's roots as JSON.
std::string gltf(const std::string& nodes, const std::string& roots) {
  const std::array<float, 12> points{0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3};
  const std::array<std::uint16_t, 12> corners{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  std::string bytes(sizeof points + sizeof corners, '\0');
  std::memcpy(bytes.data(), points.data(), sizeof points);
  std::memcpy(bytes.data() + sizeof points, corners.data(), sizeof corners);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":)" + roots + R"(}],"nodes":)" + nodes +
         R"(,"meshes":[{"name":"tetra","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,2,3]},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
"buffers":[{"byteLength":72,"uri":"data:application/octet-stream;base64,)" +
         base64(bytes) + R"("}]})";
}

Scene imported(const TemporaryFolder& folder, const std::string& nodes, const std::string& roots) {
  auto scene = datasets::make_scene(folder.file("s.gltf", gltf(nodes, roots)).string());
  EXPECT_TRUE(scene.ok()) << scene.error().line();
  return scene.ok() ? std::move(scene).value() : Scene{};
}

// Where the body shows corner 3 of the tetrahedron (the one at z = 3); vertices keep their order.
core::Vec3 farthest_corner(const Scene& scene, std::size_t body) {
  const core::Body& b = scene.bodies[body];
  core::Vec3 far;
  float most = -1.0F;
  for (const core::Vec3 v : scene.meshes[b.mesh]->vertices)
    if (core::length(v) > most) most = core::length(v), far = v;
  return b.position + core::rotate(b.orientation, far);
}

void expect_near(core::Vec3 measured, core::Vec3 expected) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(measured[k], expected[k], 1e-5F) << k;
}

TEST(ImportScene, InstancesShareOneMeshAndKeepTheirPlaces) {
  const TemporaryFolder folder;
  // A quarter turn about y takes z to x.
  const Scene scene = imported(folder,
                               R"([{"name":"a","mesh":0,"translation":[10,0,0]},
{"name":"b","mesh":0,"translation":[0,5,0],"rotation":[0,0.70710678,0,0.70710678]},
{"name":"floor_static","mesh":0,"translation":[0,-5,0]}])",
                               "[0,1,2]");
  ASSERT_EQ(scene.bodies.size(), 3U);
  EXPECT_EQ(scene.meshes.size(), 1U);
  expect_near(farthest_corner(scene, 0), {10, 0, 3});
  expect_near(farthest_corner(scene, 1), {3, 5, 0});
  EXPECT_EQ(scene.bodies[0].inverse_mass, 1.0F);
  EXPECT_EQ(scene.bodies[2].inverse_mass, 0.0F);
  EXPECT_EQ(scene.bodies[0].orientation, core::Quat{});
  EXPECT_EQ(scene.domain.min.y, -5.0F);
  EXPECT_NE(scene.meshes[0]->source.find("sha256 "), std::string::npos);
}

TEST(ImportScene, ParentsTransformTheirChildren) {
  const TemporaryFolder folder;
  // The parent moves by 1 along x after it doubled and turned a quarter about z (x to y); the child sits 1 along x.
  const Scene scene = imported(folder,
                               R"([{"children":[1],"translation":[1,0,0],"scale":[2,2,2],
"rotation":[0,0,0.70710678,0.70710678]},{"mesh":0,"translation":[1,0,0]}])",
                               "[0]");
  ASSERT_EQ(scene.bodies.size(), 1U);
  expect_near(scene.bodies[0].position, {1, 2, 0});
  expect_near(farthest_corner(scene, 0), {1, 2, 6});
  EXPECT_NEAR(core::signed_volume_m3(*scene.meshes[0]), 8.0, 1e-4);  // 1 m^3 doubled on each axis
}

TEST(ImportScene, AMirrorKeepsTrianglesFacingOutward) {
  const TemporaryFolder folder;
  const Scene scene = imported(folder, R"([{"mesh":0,"scale":[1,1,-1]},{"mesh":0,"scale":[1,1,1]}])", "[0,1]");
  ASSERT_EQ(scene.bodies.size(), 2U);
  ASSERT_EQ(scene.meshes.size(), 2U);
  expect_near(farthest_corner(scene, 0), {0, 0, -3});
  for (const auto& mesh : scene.meshes) EXPECT_NEAR(core::signed_volume_m3(*mesh), 1.0, 1e-5);
}

TEST(ImportScene, ASceneFileCanImportAndSayTheRest) {
  const TemporaryFolder folder;
  folder.file("s.gltf", gltf(R"([{"mesh":0}])", "[0]"));
  const auto scene = datasets::make_scene(
      folder.file("s.toml", "frames = 7\ngravity_m_s2 = [0.0, 0.0, -1.0]\n[import]\nfile = \"s.gltf\"\n").string());
  ASSERT_TRUE(scene.ok()) << scene.error().line();
  EXPECT_EQ(scene.value().frames, 7U);
  EXPECT_EQ(scene.value().bodies.size(), 1U);
  EXPECT_EQ(scene.value().gravity_m_s2, (core::Vec3{0.0F, 0.0F, -1.0F}));
}

TEST(ImportScene, EachBadFileIsOneClearLine) {
  const TemporaryFolder folder;
  const auto line = [](const std::filesystem::path& path) {
    const auto scene = datasets::make_scene(path.string());
    EXPECT_FALSE(scene.ok()) << path;
    if (scene.ok()) return std::string();
    EXPECT_EQ(scene.error().line().find('\n'), std::string::npos);
    return scene.error().line();
  };
  EXPECT_NE(line(folder.path() / "absent.gltf").find("no such mesh file"), std::string::npos);
  EXPECT_NE(line(folder.file("text.gltf", "no JSON")).find("not a readable mesh"), std::string::npos);
  EXPECT_NE(line(folder.file("flat.gltf", gltf(R"([{"name":"n","mesh":0,"scale":[1,0,1]}])", "[0]"))).find("node 'n'"),
            std::string::npos);
  EXPECT_NE(line(folder.file("s.toml", "[import]\nfile = \"absent.glb\"\n")).find("s.toml:1: "), std::string::npos);
}

}  // namespace
}  // namespace broadside

// Files with deep nesting, shared nodes or false lengths, or that name something that is not a file. Each gives one
// clear line, and soon. Before these checks the process ran out of stack, copied a subtree 2^24 times, waited for a
// FIFO, or cleared 4 GiB for a file of 20 bytes.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <string>

#include "core/mesh/check_gltf.hpp"
#include "core/mesh/load_mesh.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace broadside {
namespace {

using core::load_mesh;
using core::load_nodes;
using tests::TemporaryFolder;

// One triangle: three float corners, then three 16-bit indices and two bytes of padding.
std::string triangle_bytes() {
  const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint16_t corners[4] = {0, 1, 2, 0};
  std::string bytes(sizeof points + sizeof corners, '\0');
  std::memcpy(bytes.data(), points, sizeof points);
  std::memcpy(bytes.data() + sizeof points, corners, sizeof corners);
  return bytes;
}

constexpr const char* kPositions = R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})";
constexpr const char* kIndices = R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"})";

struct Parts {
  std::string nodes = R"([{"mesh":0}])";
  std::string roots = "[0]";
  std::string uri = R"("uri":"data.bin",)";
  std::string positions = kPositions;
  std::string indices = kIndices;
  std::string version = "2.0";
  std::string more = {};
};

std::string gltf(const Parts& p) {
  return R"({"asset":{"version":")" + p.version + R"("},"scene":0,"scenes":[{"nodes":)" + p.roots + R"(}],"nodes":)" +
         p.nodes + R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)" +
         p.positions + "," + p.indices +
         R"(],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":8}],)" +
         R"("buffers":[{)" + p.uri + R"("byteLength":44}])" + p.more + "}";
}

std::string word(std::uint32_t value) {
  std::string bytes;
  for (unsigned k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xFFU);
  return bytes;
}

std::string chunk(const char* type, const std::string& content) {
  return word(static_cast<std::uint32_t>(content.size())) + std::string(type, 4) + content;
}

std::string glb(const std::string& chunks) {
  return "glTF" + word(2) + word(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

class Hostile : public testing::Test {
 protected:
  Hostile() { folder_.file("data.bin", triangle_bytes()); }

  // The one error line, which both readers give.
  std::string refused(const char* name, const std::string& content) {
    const auto path = folder_.file(name, content);
    const auto mesh = load_mesh(path);
    const auto nodes = load_nodes(path);
    EXPECT_FALSE(mesh.ok());
    EXPECT_FALSE(nodes.ok());
    if (mesh.ok() || nodes.ok()) return "";
    EXPECT_EQ(mesh.error().line(), nodes.error().line());
    EXPECT_EQ(mesh.error().exit, core::Exit::kBadInput);
    EXPECT_EQ(mesh.error().line().find('\n'), std::string::npos);
    return mesh.error().line();
  }
  void expect_refused(const Parts& parts, const char* must_say) {
    const std::string line = refused("t.gltf", gltf(parts));
    EXPECT_NE(line.find(must_say), std::string::npos) << line;
  }
  void expect_read(const char* name, const std::string& content) {
    const auto mesh = load_mesh(folder_.file(name, content));
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh.value().mesh.triangles.size(), 1U);
  }

  TemporaryFolder folder_;
};

// A chain of nodes: each is the child of the one before, and the last one shows the mesh.
std::string chain(std::size_t length) {
  std::string nodes = "[";
  for (std::size_t k = 1; k < length; ++k) nodes += R"({"children":[)" + std::to_string(k) + "]},";
  return nodes + R"({"mesh":0}])";
}

TEST_F(Hostile, WhatIsWholeIsRead) {
  expect_read("t.gltf", gltf({}));
  expect_read("t.glb", glb(chunk("JSON", gltf({.uri = ""})) + chunk("BIN\0", triangle_bytes())));
  expect_read("t.gltf", gltf({.nodes = chain(core::kDeepestGltfNode)}));
  // Materials, skins and extensions are left out before assimp sees them.
  expect_read("t.gltf", gltf({.more = R"(,"skins":[{"joints":[9]}],"animations":[{"channels":7}],"materials":3)"}));
}

TEST_F(Hostile, NodesThatNestTooDeeply) {
  expect_refused({.nodes = chain(core::kDeepestGltfNode + 1)}, "more than 1000 levels deep");
  expect_refused({.nodes = chain(30000)}, "more than 1000 levels deep");
}

TEST_F(Hostile, NodesThatShareChildren) {
  std::string nodes = "[";
  for (int k = 1; k <= 40; ++k) nodes += R"({"children":[)" + std::to_string(k) + "," + std::to_string(k) + "]},";
  expect_refused({.nodes = nodes + R"({"mesh":0}])"}, "two parents");
  expect_refused({.nodes = R"([{"mesh":0,"children":[1]},{"mesh":0}])", .roots = "[0,1]"}, "has a parent");
  expect_refused({.roots = "[0,0]"}, "listed twice");
}

TEST_F(Hostile, NodesWithinThemselves) {
  expect_refused({.nodes = R"([{"children":[1]},{"children":[0],"mesh":0}])"}, "its own ancestor");
  expect_refused({.nodes = R"([{"children":[0],"mesh":0}])"}, "its own ancestor");
}

// One parser takes the first of two equal keys and another the last: what is read must be what was checked.
TEST_F(Hostile, AKeyThatComesTwiceHidesNothing) {
  expect_read("t.gltf", gltf({.nodes = chain(30000) + R"(,"nodes":[{"mesh":0}])"}));
}

TEST_F(Hostile, JsonThatNestsTooDeeply) {
  const std::string deep = std::string(200000, '[') + std::string(200000, ']');
  expect_refused({.more = R"(,"extras":)" + deep}, "64 are the most");
  expect_read("t.gltf", gltf({.more = R"(,"extras":"[[[[[\"[[[[)" + std::string(100, '[') + "\""}));
}

TEST_F(Hostile, ABufferThatIsNoRegularFile) {
  ASSERT_EQ(mkfifo((folder_.path() / "pipe").c_str(), 0600), 0);
  expect_refused({.uri = R"("uri":"pipe",)"}, "names 'pipe', which is no regular file");
  expect_refused({.uri = R"("uri":"none.bin",)"}, "no regular file");
  expect_refused({.uri = R"("uri":"../../../../../../../../dev/zero",)"}, "no regular file");
  expect_refused({.uri = R"("uri":"",)"}, "no regular file");
  expect_refused({.uri = ""}, "has no uri");
}

TEST_F(Hostile, AnObjWhoseMaterialsAreAFifo) {
  ASSERT_EQ(mkfifo((folder_.path() / "pipe").c_str(), 0600), 0);
  expect_read("t.obj", "mtllib pipe\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
}

TEST_F(Hostile, AGlbThatLiesAboutItsLengths) {
  const auto says = [&](const std::string& bytes, const char* must_say) {
    const std::string line = refused("t.glb", bytes);
    EXPECT_NE(line.find(must_say), std::string::npos) << line;
  };
  const std::string json = gltf({.uri = ""});
  says("glTF" + word(2) + word(0xFFFFFFF0U) + word(0xFFFFFFF0U) + "JSON", "its header says 4294967280 bytes");
  says("glTF" + word(2) + word(20) + word(0xFFFFFFF0U) + "JSON", "JSON chunk is longer than the file");
  says("glTF" + word(2) + word(4), "JSON chunk is longer");
  says(glb(chunk("JSON", json) + word(0xFFFFFFF0U) + std::string("BIN\0", 4)), "second chunk is longer");
  says(glb(chunk("JSON", json)), "longer than the file's body");
  says("glTF" + word(1) + word(20) + word(0) + word(0), "version 1");
}

TEST_F(Hostile, AccessorsOutsideTheirBuffer) {
  const auto positions = [](const char* text) { return Parts{.positions = text}; };
  expect_refused(positions(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})"),
                 "ends outside its bufferView");
  expect_refused(positions(R"({"bufferView":0,"byteOffset":1,"componentType":5126,"count":3,"type":"VEC3"})"),
                 "ends outside its bufferView");
  expect_refused(positions(R"({"bufferView":0,"byteOffset":-1,"componentType":5126,"count":3,"type":"VEC3"})"),
                 "offset");
  expect_refused(positions(R"({"bufferView":7,"componentType":5126,"count":3,"type":"VEC3"})"), "which does not exist");
  expect_refused(positions(R"({"componentType":5126,"count":4000000000,"type":"VEC3","sparse":{"count":1}})"),
                 "sparse");
  expect_refused(positions(R"({"bufferView":0,"componentType":5123,"count":3,"type":"VEC3"})"), "not three floats");
  expect_refused({.indices = R"({"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR"})"}, "not unsigned");
  expect_refused({.version = "1.0"}, "other than 2");
}

// Copies count, because a mesh that is read as one is written out for each node that shows it.
TEST_F(Hostile, MoreCopiesThanAreRead) {
  // 2,000 nodes of 60,003 elements.
  std::string nodes = "[";
  std::string roots = "[";
  // 17 million copies of 6 elements would be 100 MB of nodes; so many triangles in one mesh are a larger buffer
  // instead.
  const std::size_t corners = 60000;
  folder_.file("data.bin", std::string(36 + 4 * corners, '\0'));
  for (int k = 0; k < 2000; ++k) {
    nodes += std::string(k == 0 ? "" : ",") + R"({"mesh":0})";
    roots += (k == 0 ? "" : ",") + std::to_string(k);
  }
  std::string text = gltf({.nodes = nodes + "]",
                           .roots = roots + "]",
                           .indices = R"({"bufferView":1,"componentType":5125,"count":60000,"type":"SCALAR"})"});
  text.replace(text.find(R"("byteLength":8})"), 15, R"("byteLength":240000})");
  text.replace(text.find(R"("byteLength":44})"), 16, R"("byteLength":240036})");
  const std::string line = refused("t.gltf", text);
  EXPECT_NE(line.find("100000000 are the most"), std::string::npos) << line;
}

std::string polygons(std::size_t corners, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < corners; ++k)
    text += "v " + std::to_string(k) + " " + std::to_string(k * k % 1000003) + " 0\n";
  for (std::size_t f = 0; f < count; ++f) {
    text += "f";
    for (std::size_t k = 1; k <= corners; ++k) text += " " + std::to_string(k);
    text += "\n";
  }
  return text;
}

TEST_F(Hostile, PolygonsOfManyCorners) {
  std::string line = refused("t.obj", polygons(100000, 1));
  EXPECT_NE(line.find("a face has 100000 corners, and 3600 are the most"), std::string::npos) << line;
  line = refused("t.obj", polygons(3000, 2));
  EXPECT_NE(line.find("more than 50000000000, the most"), std::string::npos) << line;
}

}  // namespace
}  // namespace broadside

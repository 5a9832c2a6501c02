#include "core/mesh/load_mesh.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <sstream>
#include <string>

#include "tests/datasets/temporary_folder.hpp"

namespace broadside {
namespace {

using core::load_mesh;
using core::Mesh;
using core::Triangle;
using core::Vec3;
using tests::TemporaryFolder;

// The unit tetrahedron with right angles at the origin.
constexpr std::string_view kTetrahedronObj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string error_line(const std::filesystem::path& path) {
  const auto loaded = load_mesh(path);
  EXPECT_FALSE(loaded.ok()) << path;
  if (loaded.ok()) return "";
  EXPECT_EQ(loaded.error().exit, core::Exit::kBadInput);
  const std::string line = loaded.error().line();
  EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  EXPECT_NE(line.find(path.filename().string()), std::string::npos) << "the line does not say which file: " << line;
  return line;
}

TEST(LoadMesh, ReadsATetrahedronInEveryFormat) {
  const TemporaryFolder folder;
  const auto facet = [](const char* a, const char* b, const char* c) {
    return std::string("facet normal 0 0 0\nouter loop\nvertex ") + a + "\nvertex " + b + "\nvertex " + c +
           "\nendloop\nendfacet\n";
  };
  const char* o = "0 0 0";
  const char* x = "1 0 0";
  const char* y = "0 1 0";
  const char* z = "0 0 1";
  const std::string stl =
      "solid t\n" + facet(o, y, x) + facet(o, x, z) + facet(o, z, y) + facet(x, y, z) + "endsolid t\n";
  const std::string off = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  // One node, moved by (10, 0, 0): the node's transform must be applied. Positions, then indices, in base64.
  const std::string gltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"mesh":0,"translation":[10,0,0]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
                 {"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
    "buffers":[{"byteLength":72,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAACAAEAAAABAAMAAAADAAIAAQACAAMA"}]})";
  const std::pair<const char*, std::string> files[] = {
      {"t.obj", std::string(kTetrahedronObj)}, {"t.stl", stl}, {"t.off", off}, {"t.ply", ply}, {"t.gltf", gltf}};
  for (const auto& [name, content] : files) {
    SCOPED_TRACE(name);
    const auto loaded = load_mesh(folder.file(name, content));
    ASSERT_TRUE(loaded.ok()) << loaded.error().line();
    const Mesh& mesh = loaded.value().mesh;
    EXPECT_EQ(mesh.vertices.size(), 4U);
    EXPECT_EQ(mesh.triangles.size(), 4U);
    EXPECT_EQ(mesh.name, "t");
    EXPECT_EQ(mesh.source, name);
    EXPECT_FALSE(mesh.is_stand_in);
    EXPECT_TRUE(loaded.value().dropped.is_nothing()) << loaded.value().dropped.text();
    const float shift = std::string(name) == "t.gltf" ? 10.0F : 0.0F;
    EXPECT_EQ(core::bounds(mesh), (core::Box{{shift, 0, 0}, {shift + 1, 1, 1}}));
  }
}

TEST(LoadMesh, NormalsAndTextureCoordinatesDoNotSplitVertices) {
  const TemporaryFolder folder;
  // Every corner has a normal and a texture coordinate of its own.
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  for (int k = 1; k <= 12; ++k) obj += "vn 0 " + std::to_string(k) + " 1\nvt 0." + std::to_string(10 + k) + " 0\n";
  obj += "f 1/1/1 3/2/2 2/3/3\nf 1/4/4 2/5/5 4/6/6\nf 1/7/7 4/8/8 3/9/9\nf 2/10/10 3/11/11 4/12/12\n";
  const auto loaded = load_mesh(folder.file("t.obj", obj));
  ASSERT_TRUE(loaded.ok()) << loaded.error().line();
  EXPECT_EQ(loaded.value().mesh.vertices.size(), 4U);
}

TEST(LoadMesh, GroupsWithMaterialsOfTheirOwnShareTheirVertices) {
  const TemporaryFolder folder;
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
      "o first\nusemtl red\nf 1 3 2\nf 1 2 4\no second\nusemtl blue\nf 1 4 3\nf 2 3 4\n";
  const auto loaded = load_mesh(folder.file("t.obj", obj));
  ASSERT_TRUE(loaded.ok()) << loaded.error().line();
  EXPECT_EQ(loaded.value().mesh.vertices.size(), 4U);
  EXPECT_EQ(loaded.value().mesh.triangles.size(), 4U);
}

TEST(LoadMesh, PolygonsAreCutIntoTriangles) {
  const TemporaryFolder folder;
  const auto loaded = load_mesh(folder.file("q.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"));
  ASSERT_TRUE(loaded.ok()) << loaded.error().line();
  EXPECT_EQ(loaded.value().mesh.triangles.size(), 2U);
}

TEST(LoadMesh, DropsAndCountsWhatHasNoArea) {
  const TemporaryFolder folder;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n2 0 0\n5 5 5\n0 0 1\n"
      "3 0 1 2\n"   // stays
      "3 0 1 3\n"   // three points on the x axis
      "3 1 1 2\n"   // a repeated corner
      "3 0 2 5\n";  // stays; vertices 3 and 4 are in no triangle that stays
  const auto loaded = load_mesh(folder.file("d.ply", ply));
  ASSERT_TRUE(loaded.ok()) << loaded.error().line();
  const core::Dropped& dropped = loaded.value().dropped;
  EXPECT_EQ(loaded.value().mesh.triangles.size(), 2U);
  EXPECT_EQ(loaded.value().mesh.vertices.size(), 4U);
  EXPECT_EQ(dropped.zero_area_triangles, 1U);
  EXPECT_EQ(dropped.collapsed_triangles, 1U);
  EXPECT_EQ(dropped.unreferenced_vertices, 2U);
}

TEST(LoadMesh, EachBadFileIsOneClearLine) {
  const TemporaryFolder folder;
  const auto has = [](const std::string& line, const char* text) { return line.find(text) != std::string::npos; };
  EXPECT_TRUE(has(error_line(folder.path() / "absent.obj"), "no such mesh file"));
  std::filesystem::create_directory(folder.path() / "folder.ply");
  EXPECT_TRUE(has(error_line(folder.path() / "folder.ply"), "not a file"));
  EXPECT_TRUE(has(error_line(folder.file("m.opj", kTetrahedronObj)), "did you mean '.obj'?"));
  EXPECT_TRUE(has(error_line(folder.file("none.ply", "")), "empty"));
  EXPECT_TRUE(has(error_line(folder.file("noise.ply", "this is not a mesh\n")), "not a readable mesh"));
  EXPECT_TRUE(has(error_line(folder.file("noise.glb", std::string(100, 'x'))), "not a readable mesh"));
  EXPECT_TRUE(has(error_line(folder.file("points.ply",
                                         "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float "
                                         "y\nproperty float z\nend_header\n0 0 0\n1 0 0\n")),
                  "no triangles"));
  EXPECT_TRUE(has(error_line(folder.file("nan.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n")), "NaN or infinite"));
  EXPECT_TRUE(
      has(error_line(folder.file("inf.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 inf 0\n3 0 1 2\n")), "NaN or infinite"));
  EXPECT_TRUE(has(error_line(folder.file("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")), "degenerate"));
}

TEST(LoadMesh, AFileWithoutReadPermissionIsOneClearLine) {
  if (geteuid() == 0) GTEST_SKIP() << "root reads every file";
  const TemporaryFolder folder;
  const auto path = folder.file("t.obj", kTetrahedronObj);
  std::filesystem::permissions(path, std::filesystem::perms::none);
  EXPECT_NE(error_line(path).find("cannot be read"), std::string::npos);
}

TEST(LoadMesh, ABinaryPlyWithNanIsRefused) {
  const TemporaryFolder folder;
  std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const float v[9] = {0, 0, 0, 1, 0, 0, 0, std::nanf(""), 0};
  const std::int32_t face[3] = {0, 1, 2};
  ply.append(reinterpret_cast<const char*>(v), sizeof v);
  ply += '\3';
  ply.append(reinterpret_cast<const char*>(face), sizeof face);
  EXPECT_NE(error_line(folder.file("nan.ply", ply)).find("NaN or infinite"), std::string::npos);
}

// Truncation and absurd counts in the header: refused or read, never a crash.
TEST(LoadMesh, ADamagedPlyIsRefused) {
  const TemporaryFolder folder;
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty "
      "float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  error_line(folder.file("absurd.ply", header + "xyz"));
  EXPECT_NE(error_line(folder.file("index.ply",
                                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                                   "y\nproperty float z\nelement face 1\nproperty list uchar int "
                                   "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")),
            "");
}

// assimp tries all of its readers on a file that the reader for its extension refuses. Without the check, a damaged PLY
// file under another name was read in this way, and the reader hung. Found by fuzzing.
TEST(LoadMesh, AFileIsReadAsWhatItsNameSays) {
  const TemporaryFolder folder;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  ASSERT_TRUE(load_mesh(folder.file("t.ply", ply)).ok());
  for (const char* name : {"t.glb", "t.gltf", "t.stl", "t.off"}) error_line(folder.file(name, ply));
}

// assimp leaves out faces of more than nine corners, subtracts them from its count, and reads on: with more of them
// than faces the count became huge, and it read past the end of the list. Found by fuzzing.
TEST(LoadMesh, AnOffFileThatIsNotWholeIsRefused) {
  const TemporaryFolder folder;
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const auto refused = [&](const std::string& text) { return error_line(folder.file("t.off", text)); };
  const auto has = [](const std::string& line, const char* text) { return line.find(text) != std::string::npos; };
  EXPECT_TRUE(has(refused("OFF\n4 2 0\n" + points + "77 0 1 2\n88 0 1 2\n99 0 1 2\n" + faces), "1 to 9 corners"));
  EXPECT_TRUE(has(refused("OFF\n4 4 0\n" + points + "3 0 2 1\n"), "1 of 4 faces"));
  EXPECT_TRUE(has(refused("OFF\n9 4 0\n" + points), "4 of 9 vertices"));
  EXPECT_TRUE(has(refused("OFF\n4 1 0\n" + points + "3 0 2 4\n"), "does not exist"));
  EXPECT_TRUE(has(refused("OFF\n4 1 0\n" + points + "3 0 2\n"), "cut short"));
  EXPECT_TRUE(has(refused("OFF\n4 1 0\n" + points + std::string(5000, '3') + "\n"), "0 of 1 faces"));
  EXPECT_TRUE(has(refused("OFF\n-4 1 0\n" + points), "counts are not understood"));
  EXPECT_TRUE(has(refused("4 4 0\n" + points + faces), "does not begin with 'OFF'"));
  for (const char* start : {"OFF\n4 4 0\n", "OFF 4 4 0\n", "# text\n\nOFF\r\n# more\n4 4 6\n"}) {
    const auto loaded = load_mesh(folder.file("t.off", start + points + faces));
    ASSERT_TRUE(loaded.ok()) << start << loaded.error().line();
    EXPECT_EQ(loaded.value().mesh.triangles.size(), 4U);
  }
}

// assimp's own PLY reader runs off the end of such files, and hangs on some.
TEST(LoadMesh, APlyDamagedAnywhereIsRefusedOrReadButNeverCrashes) {
  const TemporaryFolder folder;
  std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  const std::size_t body = ply.size();
  const float v[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  ply.append(reinterpret_cast<const char*>(v), sizeof v);
  for (const core::Triangle& t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{0, 3, 2}, Triangle{1, 2, 3}}) {
    ply += '\3';
    ply.append(reinterpret_cast<const char*>(t.data()), sizeof t);
  }
  ASSERT_TRUE(load_mesh(folder.file("whole.ply", ply)).ok());
  // Cut at any place: always an error.
  for (std::size_t size = 0; size < ply.size(); size += size < body ? 7 : 3)
    error_line(folder.file("cut.ply", ply.substr(0, size)));
  // One byte changed anywhere in the header, or in the lists' lengths: any result will do, but the process survives.
  for (std::size_t at = 0; at < ply.size(); ++at) {
    std::string damaged = ply;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x15);
    const auto loaded = load_mesh(folder.file("damaged.ply", damaged));
    const std::string line = loaded.ok() ? "" : loaded.error().line();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = ply;
    changed.replace(changed.find(from), from.size(), to);
    return error_line(folder.file("changed.ply", changed));
  };
  EXPECT_NE(with("vertex 4", "vertex 40").find("shorter than its header says"), std::string::npos);
  EXPECT_NE(with("face 4", "face 4000000000").find("shorter than its header says"), std::string::npos);
  EXPECT_NE(with("float y", "flaot y").find("line 5 of its header"), std::string::npos);
  EXPECT_NE(with("uchar int", "uchar float").find("whole numbers"), std::string::npos);
  EXPECT_NE(with("float z", "float w").find("no vertices with x, y and z"), std::string::npos);
}

TEST(Normalized, LongestSideIsExactAndTheCenterIsTheOrigin) {
  Mesh mesh;
  mesh.vertices = {{1, 2, 3}, {5, 3, 4}, {1, 4, 3.5F}};
  mesh.triangles = {{0, 1, 2}};
  const Mesh scaled = core::normalized(mesh, 1.0);
  // Sides 4, 2, 1 become 1, 1/2, 1/4: exact in binary.
  EXPECT_EQ(core::bounds(scaled), (core::Box{{-0.5F, -0.25F, -0.125F}, {0.5F, 0.25F, 0.125F}}));
  EXPECT_EQ(scaled.vertices[2], (Vec3{-0.5F, 0.25F, 0.0F}));
}

}  // namespace
}  // namespace broadside

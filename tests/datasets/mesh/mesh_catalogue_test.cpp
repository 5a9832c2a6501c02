#include "datasets/mesh/mesh_catalogue.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "core/mesh/load_mesh.hpp"
#include "core/mesh/topology.hpp"
#include "core/scene/primitive.hpp"
#include "datasets/mesh/acquire_mesh.hpp"
#include "datasets/mesh/sha256.hpp"
#include "tests/core/mesh/mesh_topology.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace broadside {
namespace {

using core::Mesh;
using datasets::acquire_mesh;
using datasets::MeshOptions;
using tests::TemporaryFolder;

// A second, ten-line reader of the catalogue's own format (binary little-endian PLY, float xyz, uchar + 3 int32), so
// that the expected bits do not come from the loader.
Mesh read_binary_ply(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  Mesh mesh;
  for (std::string line; std::getline(file, line) && line != "end_header";) {
    if (line.starts_with("element vertex ")) mesh.vertices.resize(std::stoul(line.substr(15)));
    if (line.starts_with("element face ")) mesh.triangles.resize(std::stoul(line.substr(13)));
  }
  file.read(reinterpret_cast<char*>(mesh.vertices.data()),
            static_cast<std::streamsize>(mesh.vertices.size() * sizeof(core::Vec3)));
  for (core::Triangle& t : mesh.triangles) {
    EXPECT_EQ(file.get(), 3);
    file.read(reinterpret_cast<char*>(t.data()), sizeof t);
  }
  EXPECT_TRUE(file.good());
  return mesh;
}

TEST(Sha256, GivesThePublishedSums) {
  const TemporaryFolder folder;
  // FIPS 180-4 examples: the empty message, and "abc".
  EXPECT_EQ(datasets::sha256_of_file(folder.file("empty", "")).value(),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(datasets::sha256_of_file(folder.file("abc", "abc")).value(),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_FALSE(datasets::sha256_of_file(folder.path() / "absent").ok());
}

TEST(MeshCatalogue, EveryRowIsWhole) {
  std::set<std::string_view> names;
  for (const auto& row : datasets::mesh_catalogue()) {
    SCOPED_TRACE(row.name);
    EXPECT_TRUE(names.insert(row.name).second) << "named twice";
    EXPECT_FALSE(row.what.empty());
    EXPECT_FALSE(row.credit.empty());
    EXPECT_GT(row.triangles, 0U);
    EXPECT_EQ(row.is_procedural, row.files.empty());
    for (const auto& file : row.files) {
      EXPECT_TRUE(file.sha256.empty() || file.sha256.size() == 64U) << file.file;
      // A file without a published sum must be one that is made here.
      EXPECT_TRUE(!file.sha256.empty() || file.source != nullptr) << file.file;
      EXPECT_TRUE(file.sha256.empty() || file.covering_radius > 0.0) << file.file;
    }
  }
}

TEST(MeshCatalogue, UnknownNameGetsTheNearest) {
  const auto found = datasets::find_mesh("buny");
  ASSERT_FALSE(found.ok());
  EXPECT_NE(found.error().line().find("did you mean 'bunny'?"), std::string::npos) << found.error().line();
}

TEST(AcquireMesh, ProceduralMeshesNeedNoFileAndAreNoStandIns) {
  for (const auto& row : datasets::mesh_catalogue()) {
    if (!row.is_procedural) continue;
    SCOPED_TRACE(row.name);
    const auto mesh = acquire_mesh(row.name, MeshOptions{});
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh.value().vertices.size(), row.vertices);
    EXPECT_EQ(mesh.value().triangles.size(), row.triangles);
    EXPECT_FALSE(mesh.value().is_stand_in);
    EXPECT_TRUE(mesh.value().source.starts_with("procedural"));
  }
}

TEST(AcquireMesh, ShapesAreThePrimitivesThatTheirNamesSay) {
  const auto kind_of = [](std::string_view name) {
    const auto found = core::primitive_of(acquire_mesh(name, MeshOptions{}).value());
    return found ? std::string(core::primitive_word(found->kind)) : "none";
  };
  for (const char* name : {"cube", "brick", "domino"}) EXPECT_EQ(kind_of(name), "box") << name;
  for (const char* name : {"sphere", "capsule", "cylinder"}) EXPECT_EQ(kind_of(name), name);
  const core::Mesh stone = acquire_mesh("stone", MeshOptions{}).value();
  EXPECT_TRUE(core::is_convex(stone) && !core::primitive_of(stone));
}

TEST(AcquireMesh, WithoutAFileItSaysWhatToDo) {
  const auto mesh = acquire_mesh("bunny", MeshOptions{});
  ASSERT_FALSE(mesh.ok());
  EXPECT_NE(mesh.error().line().find("broadside fetch bunny"), std::string::npos) << mesh.error().line();
  EXPECT_NE(mesh.error().line().find("BROADSIDE_MESH_DIR"), std::string::npos);
}

TEST(AcquireMesh, TheProceduralBodyIsOfTheSizeClassAndSaysThatItStandsIn) {
  MeshOptions options;
  options.allow_procedural = true;
  for (const char* name : {"bunny", "armadillo", "dragon"}) {
    const auto mesh = acquire_mesh(name, options);
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    const auto* row = datasets::find_mesh(name).value();
    EXPECT_TRUE(mesh.value().is_stand_in);
    EXPECT_EQ(mesh.value().name, name);
    EXPECT_TRUE(mesh.value().source.starts_with("procedural")) << mesh.value().source;
    // T = 20 f^2 for whole f: next to the target the steps are 40 f, so half a step is sqrt(T / 20) * 20 away at most.
    EXPECT_NEAR(static_cast<double>(mesh.value().triangles.size()), row->triangles,
                20.0 * std::sqrt(row->triangles / 20.0) + 5.0);
    EXPECT_TRUE(tests::is_closed(mesh.value()));
    EXPECT_EQ(tests::euler_characteristic(mesh.value()), 2);
  }
}

TEST(AcquireMesh, ADamagedFileIsNeverPassedOver) {
  const TemporaryFolder folder;
  folder.file("bunny_2503v_4968t.ply", "ply damaged");
  MeshOptions options;
  options.mesh_dir = folder.path();
  options.allow_procedural = true;
  const auto mesh = acquire_mesh("bunny", options);
  ASSERT_FALSE(mesh.ok());
  EXPECT_NE(mesh.error().line().find("SHA-256"), std::string::npos) << mesh.error().line();
  EXPECT_NE(mesh.error().line().find("bunny_2503v_4968t.ply"), std::string::npos);
}

TEST(AcquireMesh, AFileMadeHereIsCheckedAgainstTheSumBesideIt) {
  const TemporaryFolder folder;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const auto path = folder.file("dragon_100000t.ply", ply);
  MeshOptions options;
  options.cache_dir = folder.path();
  EXPECT_FALSE(acquire_mesh("dragon", options).ok()) << "there is no sum beside it";
  folder.file("dragon_100000t.ply.sha256", datasets::sha256_of_file(path).value() + "  dragon_100000t.ply\n");
  const auto mesh = acquire_mesh("dragon", options);
  ASSERT_TRUE(mesh.ok()) << mesh.error().line();
  EXPECT_FALSE(mesh.value().is_stand_in);
  EXPECT_TRUE(mesh.value().source.starts_with("dragon_100000t.ply sha256 ")) << mesh.value().source;
}

TEST(AcquireMesh, PublishedFilesLoadBitExactlyInFileOrder) {
  const char* folder = std::getenv("BROADSIDE_MESH_DIR");
  if (folder == nullptr) GTEST_SKIP() << "BROADSIDE_MESH_DIR is not set: no mesh files to read";
  int read = 0;
  for (const auto& row : datasets::mesh_catalogue()) {
    for (const auto& file : row.files) {
      const auto path = std::filesystem::path(folder) / file.file;
      // The largest one takes seconds and has no property that the others lack.
      if (file.sha256.empty() || file.triangles > 200'000 || !std::filesystem::exists(path)) continue;
      SCOPED_TRACE(file.file);
      const auto loaded = core::load_mesh(path);
      ASSERT_TRUE(loaded.ok()) << loaded.error().line();
      const Mesh expected = read_binary_ply(path);
      const Mesh& mesh = loaded.value().mesh;
      ASSERT_EQ(mesh.vertices.size(), file.vertices);
      ASSERT_EQ(mesh.triangles.size(), file.triangles);
      EXPECT_TRUE(loaded.value().dropped.is_nothing()) << loaded.value().dropped.text();
      EXPECT_EQ(std::memcmp(mesh.vertices.data(), expected.vertices.data(), mesh.vertices.size() * sizeof(core::Vec3)),
                0);
      EXPECT_EQ(mesh.triangles, expected.triangles);
      const core::Topology topology = core::topology(mesh);
      EXPECT_TRUE(topology.is_manifold());
      EXPECT_EQ(topology.boundary_edges, file.boundary_edges);
      EXPECT_EQ(topology.euler_characteristic, file.euler_characteristic);
      // Written down from another program; both work in double.
      EXPECT_NEAR(core::covering_radius_m(mesh) / file.covering_radius, 1.0, 1e-9);
      ++read;
    }
  }
  if (read == 0) GTEST_SKIP() << "BROADSIDE_MESH_DIR has none of the catalogue's files";
}

TEST(AcquireMesh, TheBunnyIsThePapersTriangleCount) {
  const MeshOptions options = MeshOptions::from_environment();
  if (options.mesh_dir.empty()) GTEST_SKIP() << "BROADSIDE_MESH_DIR is not set: no bunny to read";
  const auto mesh = acquire_mesh("bunny", options);
  ASSERT_TRUE(mesh.ok()) << mesh.error().line();
  EXPECT_EQ(mesh.value().triangles.size(), 4968U);
  EXPECT_FALSE(mesh.value().is_stand_in);
  EXPECT_NE(mesh.value().source.find("sha256 "), std::string::npos);
}

}  // namespace
}  // namespace broadside

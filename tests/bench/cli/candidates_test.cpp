// Candidates of continuous collision as a user asks for them: from a formula, from two mesh files, and as queries.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "datasets/mesh/write_ply.hpp"
#include "datasets/shapes/sphere_mesh.hpp"
#include "tests/bench/cli/program.hpp"

namespace broadside::tests {
namespace {

using nlohmann::json;

TEST(Candidates, EnginesAgreeWithEveryPairOfFeatures) {
  for (const std::string motion : {"folding-sheet:1000", "moving-heap:1600"}) {
    const Ended ended = run_program(
        {"candidates", motion, "--engine", "octree-cpu", "--engine", "embree-collide", "--try-all", "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const json rows = json::parse(ended.out);
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_GT(rows[0].at("vertex_face").get<int>(), 100);
    for (const json& row : rows) EXPECT_EQ(row.at("digest"), rows[0].at("digest")) << row.at("engine");
  }
}

// A ball of 1,280 triangles that is squeezed flat, past its own other side.
TEST(Candidates, OfTwoStatesOfAMesh) {
  const ScratchFolder folder;
  core::Mesh ball = datasets::sphere_mesh(1.0, 4).value();
  const auto start = folder / "start.ply";
  const auto end = folder / "end.ply";
  ASSERT_TRUE(datasets::write_ply(ball, start).ok());
  for (core::Vec3& v : ball.vertices) v.z *= -0.1F;
  ASSERT_TRUE(datasets::write_ply(ball, end).ok());
  const Ended ended = run_program({"candidates", start.string(), "--to", end.string(), "--engine", "octree-cpu",
                                   "--try-all", "--queries", (folder / "queries").string()});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  // The saved queries are asked as they are, and no engine of ours misses one.
  for (const std::string kind : {"vertex-face", "edge-edge"}) {
    const Ended asked =
        run_program({"agree", "--motion", kind, "--case", (folder / "queries" / (kind + ".csv")).string(), "--engine",
                     "feature-impact", "--out", (folder / "out").string()});
    EXPECT_EQ(asked.exit_code, 0) << asked.out << asked.err;
    EXPECT_EQ(asked.out.find("the file disagrees"), std::string::npos);
  }
}

TEST(Candidates, BadInputIsOneLine) {
  const ScratchFolder folder;
  const auto file = folder / "ball.ply";
  const auto other = folder / "other.ply";
  ASSERT_TRUE(datasets::write_ply(datasets::sphere_mesh(1.0, 2).value(), file).ok());
  ASSERT_TRUE(datasets::write_ply(datasets::sphere_mesh(1.0, 3).value(), other).ok());
  const std::vector<std::vector<std::string>> bad = {
      {"candidates", "folding-shet:100", "--engine", "octree-cpu"},
      {"candidates", "folding-sheet:many", "--engine", "octree-cpu"},
      {"candidates", "folding-sheet:100", "--engine", "fcl-mesh"},
      {"candidates", file.string(), "--engine", "octree-cpu"},
      {"candidates", file.string(), "--to", other.string(), "--engine", "octree-cpu"},
      {"candidates", file.string(), "--to", (folder / "none.ply").string(), "--engine", "octree-cpu"},
  };
  for (const auto& arguments : bad) {
    const Ended ended = run_program(arguments);
    EXPECT_EQ(ended.exit_code, 2) << arguments[1] << " " << ended.err;
    EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  }
}

}  // namespace
}  // namespace broadside::tests

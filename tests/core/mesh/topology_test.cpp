// Topology, volume and crossings of meshes whose answers are known without computing.
#include "core/mesh/topology.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "datasets/decimate/decimate.hpp"
#include "datasets/decimate/self_intersection.hpp"
#include "datasets/shapes/box_mesh.hpp"
#include "datasets/shapes/sphere_mesh.hpp"

namespace broadside {
namespace {

using core::Mesh;

Mesh tetrahedron(core::Vec3 at = {}) {
  Mesh mesh;
  mesh.vertices = {at, at + core::Vec3{1, 0, 0}, at + core::Vec3{0, 1, 0}, at + core::Vec3{0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

Mesh both(const Mesh& a, const Mesh& b) {
  Mesh mesh = a;
  const auto base = static_cast<std::uint32_t>(a.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const core::Triangle& t : b.triangles) mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  return mesh;
}

TEST(Topology, OfATetrahedron) {
  const core::Topology t = core::topology(tetrahedron());
  EXPECT_TRUE(t.is_closed());
  EXPECT_EQ(t.edges, 6U);
  EXPECT_EQ(t.components, 1U);
  EXPECT_EQ(t.euler_characteristic, 2);
  EXPECT_EQ(t.misoriented_edges, 0U);
  EXPECT_NEAR(core::signed_volume_m3(tetrahedron({5, -3, 2})), 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(core::area_m2(tetrahedron()), 1.5 + std::sqrt(3.0) / 2.0, 1e-12);
}

TEST(Topology, OfBoxesAndSpheres) {
  const Mesh box = datasets::box_mesh({2.0, 3.0, 4.0}, {3, 5, 2}).value();
  EXPECT_TRUE(core::topology(box).is_closed());
  EXPECT_NEAR(core::signed_volume_m3(box), 24.0, 1e-5);
  EXPECT_NEAR(core::area_m2(box), 52.0, 1e-5);
  EXPECT_EQ(core::topology(both(box, datasets::sphere_mesh(0.5, 4).value())).euler_characteristic, 4);
  EXPECT_EQ(core::topology(both(box, tetrahedron())).components, 2U);
}

TEST(Topology, AMissingTriangleLeavesThreeBoundaryEdges) {
  Mesh mesh = tetrahedron();
  mesh.triangles.pop_back();
  const core::Topology t = core::topology(mesh);
  EXPECT_TRUE(t.is_manifold());
  EXPECT_FALSE(t.is_closed());
  EXPECT_EQ(t.boundary_edges, 3U);
  EXPECT_EQ(t.euler_characteristic, 1);
}

TEST(Topology, ATurnedTriangleIsMisorientedOnItsThreeEdges) {
  Mesh mesh = tetrahedron();
  std::swap(mesh.triangles[1][0], mesh.triangles[1][1]);
  EXPECT_EQ(core::topology(mesh).misoriented_edges, 3U);
  EXPECT_EQ(core::topology(mesh).boundary_edges, 0U);
}

TEST(Topology, AThirdTriangleOnAnEdgeIsNoManifold) {
  Mesh mesh = tetrahedron();
  mesh.vertices.push_back({1, 1, 1});
  mesh.triangles.push_back({0, 1, 4});
  const core::Topology t = core::topology(mesh);
  EXPECT_EQ(t.non_manifold_edges, 1U);
  EXPECT_EQ(t.boundary_edges, 2U);
  EXPECT_FALSE(t.is_manifold());
}

TEST(Topology, TwoBodiesAtOneCornerAreNoManifold) {
  Mesh mesh = both(tetrahedron(), tetrahedron({1, 0, 0}));
  // The first corner of the second body is the second corner of the first.
  for (core::Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t)
      if (v == 4) v = 1;
  const core::Topology t = core::topology(mesh);
  EXPECT_EQ(t.non_manifold_vertices, 1U);
  EXPECT_EQ(t.non_manifold_edges, 0U);
  EXPECT_EQ(t.boundary_edges, 0U);
  EXPECT_EQ(t.components, 1U);
  EXPECT_FALSE(t.is_closed());
}

class Crossings : public testing::Test {
 protected:
  void SetUp() override {
    if (!datasets::can_decimate()) GTEST_SKIP() << "built without CGAL";
  }
  static std::uint64_t count(const Mesh& mesh) {
    const auto pairs = datasets::self_intersecting_pairs(mesh);
    EXPECT_TRUE(pairs.ok()) << pairs.error().line();
    return pairs.ok() ? pairs.value() : 0;
  }
};

TEST_F(Crossings, SoundBodiesHaveNone) {
  EXPECT_EQ(count(tetrahedron()), 0U);
  EXPECT_EQ(count(datasets::box_mesh({1.0, 1.0, 1.0}, {4, 4, 4}).value()), 0U);
  EXPECT_EQ(count(datasets::lumpy_mesh(500, 1).value()), 0U);
}

TEST_F(Crossings, AreFoundWithoutSharedCorners) {
  Mesh mesh;
  mesh.vertices = {{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, 1, 0}, {0, 0, 5}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(count(mesh), 1U);
  mesh.vertices[5] = {5, 0, 0};  // passes beside
  mesh.vertices[3] = {3, -1, 0};
  mesh.vertices[4] = {3, 1, 0};
  EXPECT_EQ(count(mesh), 0U);
}

TEST_F(Crossings, AreFoundBeyondASharedCornerAndAFoldedEdge) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, -1, 0}, {2, 1, 0}, {2, 0, -1}, {2, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(count(mesh), 1U);
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};  // the second is folded back over the first
  EXPECT_EQ(count(mesh), 1U);
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};  // flat, side by side
  EXPECT_EQ(count(mesh), 0U);
  mesh.triangles = {{0, 1, 2}, {2, 0, 1}};
  EXPECT_EQ(count(mesh), 1U);
}

}  // namespace
}  // namespace broadside

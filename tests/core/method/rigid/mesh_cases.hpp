// Meshes for the tests of manifolds.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/exact/convex_hull.hpp"
#include "core/scene/triangle_tree.hpp"
#include "tests/core/method/rigid/manifold_cases.hpp"

namespace broadside::core {

// Owns what the shape's view points to.
struct MeshBody {
  Mesh mesh;
  TriangleTables tables;
  ContactShape shape;
  ContactPose pose;

  explicit MeshBody(Mesh given, bool is_closed_mesh = false) : mesh(std::move(given)), tables(triangle_tables(mesh)) {
    shape.kind = ContactKind::kMesh;
    shape.mesh = {mesh.vertices.data(),
                  tables.triangles.data(),
                  tables.normals.data(),
                  tables.least_facing.data(),
                  tables.nodes.data(),
                  static_cast<std::uint32_t>(mesh.vertices.size()),
                  static_cast<std::uint32_t>(tables.normals.size()),
                  static_cast<std::uint32_t>(tables.nodes.size())};
    shape.mesh.is_closed = is_closed_mesh;
    for (const Vec3 v : mesh.vertices) shape.size_m = std::max(shape.size_m, length(v));
  }
  MeshBody(const MeshBody&) = delete;
  MeshBody& operator=(const MeshBody&) = delete;
};

inline float deepest(const Manifold* m, int count) {
  float least = 1e30F;
  for (int k = 0; k < count; ++k)
    for (int p = 0; p < m[k].count; ++p) least = std::min(least, m[k].points[p].gap_m);
  return least;
}

inline Mesh random_hull(Draw& draw, int point_count = 20) {
  std::vector<Vec3> points;
  for (int k = 0; k < point_count; ++k) points.push_back(0.7F * normalized(draw.in_cube(1.0F)));
  return *exact::convex_hull(points);
}

// A floor of 2 x 8 x 8 triangles, 4 m wide, about the origin; open, seen from above.
inline Mesh floor_mesh() {
  Mesh mesh;
  for (int i = 0; i <= 8; ++i)
    for (int k = 0; k <= 8; ++k)
      mesh.vertices.push_back({0.5F * static_cast<float>(i - 4), 0.0F, 0.5F * static_cast<float>(k - 4)});
  for (std::uint32_t i = 0; i < 8; ++i)
    for (std::uint32_t k = 0; k < 8; ++k) {
      const std::uint32_t v = 9 * i + k;
      mesh.triangles.push_back({v, v + 1, v + 10});
      mesh.triangles.push_back({v, v + 10, v + 9});
    }
  return mesh;
}

// Puts B at this signed distance from A, in a direction from A.
inline void place_apart(const Subject& a, Subject& b, Vec3 direction, double wanted_m) {
  double low = 0.0;
  double high = 4.0;
  for (int k = 0; k < 20; ++k) {
    b.pose.x = a.pose.x + static_cast<float>(0.5 * (low + high)) * direction;
    const double found = exact::signed_distance(a.placed(), b.placed()).distance_m;
    (found < wanted_m ? low : high) = 0.5 * (low + high);
  }
}

}  // namespace broadside::core

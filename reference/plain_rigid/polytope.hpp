// A convex polytope in body coordinates: boxes and convex meshes of plain-rigid.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/scene/mesh.hpp"
#include "reference/plain_rigid/linear.hpp"

namespace broadside::reference::plain {

struct PolytopeFace {
  std::vector<std::uint32_t> corners;  // counterclockwise, seen from outside
  Vec normal;                          // unit, outward
};

struct Polytope {
  std::vector<Vec> vertices;  // m
  std::vector<PolytopeFace> faces;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<Vec> directions;  // of edges, unit, distinct up to sign
};

// A box about the origin.
Polytope box_polytope(Vec half_extents);
// Made from a convex mesh (core::is_convex): triangles of one plane become one face.
Polytope polytope_of(const core::Mesh& mesh);
// The same polytope at a pose.
Polytope placed(const Polytope& shape, const Mat& rotation, Vec origin);

}  // namespace broadside::reference::plain

// The octree over one mesh's vertices: 1 + 8 + 64 tight boxes, and each vertex's leaf. METHOD section 2 and P-Alg A1.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

constexpr int kBodyOctreeLevels = 3;
constexpr int kBodyOctreeNodes = 1 + 8 + 64;
// First node and node count of each level; the children of node n are 8 n + 1 ... 8 n + 8.
constexpr std::array<int, kBodyOctreeLevels> kLevelOffset{0, 1, 9};
constexpr std::array<int, kBodyOctreeLevels> kLevelSize{1, 8, 64};
constexpr int first_child(int node) {
  return 8 * node + 1;
}

// Boxes and vertices are in body coordinates, with the body's orientation already applied: world = this + position. A
// node's box is the tight box of its vertices; a node without vertices has the empty box and is skipped. A vertex is in
// the upper octant on an axis when it is at or above the center of its cell; cells halve the root box.
struct BodyOctree {
  std::array<Box, kBodyOctreeNodes> boxes;
  // P-Alg A1: the leaf of each vertex of the mesh (0..63, counted within level 2).
  std::vector<std::uint8_t> leaf_of_vertex;
  // Vertices sorted by leaf, and within a leaf in the mesh's order: leaf k has sorted_vertices[leaf_begin[k] ..
  // leaf_begin[k+1]). Leaves of one level-1 node are neighbors, so every node is one contiguous range.
  std::array<std::uint32_t, 65> leaf_begin;
  std::vector<std::uint32_t> sorted_indices;  // sorted -> index in the mesh
  std::vector<Vec3> sorted_vertices;
};

BodyOctree build_body_octree(std::span<const Vec3> vertices);

}  // namespace broadside::core

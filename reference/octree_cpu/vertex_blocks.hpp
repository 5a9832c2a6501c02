// The vertices of one shape, grouped by leaf of its octree, and within a leaf by a tree of boxes. The search for the
// nearest vertices of two shapes runs over these.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/scene/body_octree.hpp"

namespace broadside::reference {

// A leaf of a mesh of 360,000 vertices holds ten thousand of them. Without boxes inside the leaf, all of them would be
// searched for each pair of leaves that are near. In body coordinates, like the octree's boxes.
struct VertexBlocks {
  struct Node {
    core::Box box;  // tight
    std::uint32_t first = 0, last = 0;
    std::uint32_t child = 0;  // the first of two; 0 = no children: the node is a block
  };
  std::vector<Node> nodes;
  std::array<std::uint32_t, 64> root{};  // of each leaf that has vertices
  std::vector<core::Vec3> vertices;
  std::vector<std::uint32_t> indices;  // the vertices' numbers in the mesh
};

VertexBlocks make_vertex_blocks(const core::BodyOctree& tree);

}  // namespace broadside::reference

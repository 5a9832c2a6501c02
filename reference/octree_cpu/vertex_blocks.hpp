// The vertices of one shape by leaf of its octree, and within a leaf by a tree of boxes: what the nearest vertices of
// two shapes are searched in.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/scene/body_octree.hpp"

namespace broadside::reference {

// A leaf of a mesh of 360,000 vertices holds ten thousand of them: without boxes of its own it would be searched from
// end to end for each pair of leaves that are near. In body coordinates, as the octree's boxes.
struct VertexBlocks {
  struct Node {
    core::Box box;  // tight
    std::uint32_t first = 0, last = 0;
    std::uint32_t child = 0;  // the first of two; 0 = none: a block
  };
  std::vector<Node> nodes;
  std::array<std::uint32_t, 64> root{};  // of each leaf that has vertices
  std::vector<core::Vec3> vertices;
  std::vector<std::uint32_t> indices;  // of them in the mesh
};

VertexBlocks make_vertex_blocks(const core::BodyOctree& tree);

}  // namespace broadside::reference

// The tree over a mesh's triangles that contacts use to find nearby triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "core/method/rigid/contact_shape.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

struct TriangleTables {
  std::vector<std::uint32_t> triangles;  // three corners each, in the order of the tree
  std::vector<Vec3> normals;
  std::vector<float> least_facing;
  std::vector<TriangleNode> nodes;
};

// Nodes are halved at the median along their longest side until they hold at most four triangles: less than 32 levels
// for any mesh that 32 bits can number. Triangles without area are left out.
TriangleTables triangle_tables(const Mesh& mesh);

}  // namespace broadside::core

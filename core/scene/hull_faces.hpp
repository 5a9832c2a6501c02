// The faces and edges of a convex polyhedron that is given by triangles: triangles in one plane form one face.
#pragma once

#include <cstdint>
#include <vector>

#include "core/method/rigid/contact_shape.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

struct HullTables {
  std::vector<Vec3> vertices;  // the vertices on the hull's edges
  std::vector<HullFace> faces;
  std::vector<std::uint32_t> corners;
  std::vector<HullEdge> edges;
  std::vector<HullWay> ways;  // these three as in HullView
  std::vector<std::uint32_t> guide;
  std::vector<std::uint32_t> beyond;
};

// mesh: closed and convex, triangles outward. A face of more than kFaceCorners corners becomes several in one plane.
HullTables hull_tables(const Mesh& mesh);

}  // namespace broadside::core

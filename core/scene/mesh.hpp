// A triangle mesh in body coordinates (m), as every engine receives it: scaled, centered and cleaned.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/math/box.hpp"
#include "core/math/vec3.hpp"

namespace broadside::core {

using Triangle = std::array<std::uint32_t, 3>;

struct Mesh {
  std::string name;          // "bunny"
  std::string source;        // origin of the vertices, for provenance: a file name and its sha256, or "procedural"
  bool is_stand_in = false;  // true when this is not the mesh that was asked for; every report says so
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

// Tight box of the vertices; empty for a mesh without vertices.
Box bounds(const Mesh& mesh);

// Mean length of the distinct edges, in meters, summed in double. 0 for a mesh without triangles.
float mean_edge_m(const Mesh& mesh);

// rho of METHOD section 3: the largest distance from a point of the surface to its triangle's nearest vertex, in
// meters. Exact per triangle: the circumradius when acute, otherwise reached on the longest edge.
double covering_radius_m(const Mesh& mesh);

}  // namespace broadside::core

// How a mesh's triangles are connected, and what they enclose.
#pragma once

#include <cstdint>

#include "core/scene/mesh.hpp"

namespace broadside::core {

// Counts edges and vertices that triangles use; a mesh that load_mesh returned has no others.
struct Topology {
  std::uint64_t edges = 0;
  std::uint64_t boundary_edges = 0;         // edges of one triangle
  std::uint64_t non_manifold_edges = 0;     // edges of three or more triangles
  std::uint64_t misoriented_edges = 0;      // edges of two triangles with opposite orientations
  std::uint64_t non_manifold_vertices = 0;  // vertices whose triangles form more than one fan
  std::uint64_t components = 0;             // parts that share no vertex
  std::int64_t euler_characteristic = 0;    // V - E + T: 2 for each closed component like a sphere, minus 2 per handle

  [[nodiscard]] bool is_manifold() const { return non_manifold_edges == 0 && non_manifold_vertices == 0; }
  [[nodiscard]] bool is_closed() const { return is_manifold() && boundary_edges == 0; }
};

Topology topology(const Mesh& mesh);

// By the divergence theorem, in m^3; positive when the triangles face outward. It is the enclosed volume only for a
// closed mesh that is consistently oriented and does not cross itself.
double signed_volume_m3(const Mesh& mesh);

double area_m2(const Mesh& mesh);

}  // namespace broadside::core

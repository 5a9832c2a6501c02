// All facts about a mesh that 'broadside mesh' prints and that the catalogue states about its files.
#pragma once

#include <cstdint>
#include <optional>

#include "core/mesh/clean_mesh.hpp"
#include "core/mesh/topology.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

struct MeshFacts {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  core::Dropped dropped;  // on reading: degenerate triangles and the like
  core::Topology topology;
  // Number of pairs of triangles that cross; nothing where CGAL is not built in.
  std::optional<std::uint64_t> self_intersecting_pairs;
  core::Box bounds;
  double area_m2 = 0.0;
  double volume_m3 = 0.0;  // signed; the enclosed volume only when closed and consistently oriented
  double mean_edge_m = 0.0;
  double covering_radius_m = 0.0;  // rho of METHOD section 3
};

// Lengths are in the mesh's own unit, called m here. count_crossings: use CGAL, which takes seconds on the largest
// meshes.
MeshFacts mesh_facts(const core::Mesh& mesh, const core::Dropped& dropped, bool count_crossings);

}  // namespace broadside::datasets

// Everything that 'broadside mesh' says about a mesh, and that the catalogue claims of its files.
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
  // Pairs of triangles; nothing where CGAL is not built in.
  std::optional<std::uint64_t> self_intersecting_pairs;
  core::Box bounds;
  double area_m2 = 0.0;
  double volume_m3 = 0.0;  // signed; enclosed only when closed and consistently turned
  double mean_edge_m = 0.0;
  double covering_radius_m = 0.0;  // rho of METHOD section 3
};

// In the mesh's own unit, called m here. count_crossings: ask CGAL, which takes seconds on the largest meshes.
MeshFacts mesh_facts(const core::Mesh& mesh, const core::Dropped& dropped, bool count_crossings);

}  // namespace broadside::datasets

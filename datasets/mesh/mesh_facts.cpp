#include "datasets/mesh/mesh_facts.hpp"

#include "datasets/decimate/self_intersection.hpp"

namespace broadside::datasets {

MeshFacts mesh_facts(const core::Mesh& mesh, const core::Dropped& dropped, bool count_crossings) {
  MeshFacts facts;
  facts.vertices = mesh.vertices.size();
  facts.triangles = mesh.triangles.size();
  facts.dropped = dropped;
  facts.topology = core::topology(mesh);
  if (count_crossings) {
    const core::Result<std::uint64_t> pairs = self_intersecting_pairs(mesh);
    if (pairs) facts.self_intersecting_pairs = pairs.value();
  }
  facts.bounds = core::bounds(mesh);
  facts.area_m2 = core::area_m2(mesh);
  facts.volume_m3 = core::signed_volume_m3(mesh);
  facts.mean_edge_m = core::mean_edge_m(mesh);
  facts.covering_radius_m = core::covering_radius_m(mesh);
  return facts;
}

}  // namespace broadside::datasets

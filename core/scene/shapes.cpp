#include "core/scene/shapes.hpp"

#include <map>
#include <tuple>

#include "core/method/proximity.hpp"

namespace broadside::core {

ShapeTable build_shapes(const Scene& scene) {
  ShapeTable table;
  std::vector<float> mean_edges;
  for (const auto& mesh : scene.meshes) mean_edges.push_back(mean_edge_m(*mesh));

  std::map<std::tuple<std::uint32_t, float, float, float, float>, std::uint32_t> known;
  for (const Body& body : scene.bodies) {
    const Quat q = body.orientation;
    const auto [entry, is_new] =
        known.try_emplace({body.mesh, q.w, q.x, q.y, q.z}, static_cast<std::uint32_t>(table.shapes.size()));
    if (is_new) {
      std::vector<Vec3> turned = scene.meshes[body.mesh]->vertices;
      for (Vec3& v : turned) v = rotate(q, v);
      table.shapes.push_back({body.mesh, mean_edges[body.mesh], build_body_octree(turned)});
    }
    table.shape_of_body.push_back(entry->second);
  }
  return table;
}

float pair_theta_m(const Parameters& parameters, const Shape& a, const Shape& b) {
  return pair_theta_m(parameters, a.mean_edge_m, b.mean_edge_m);
}

}  // namespace broadside::core

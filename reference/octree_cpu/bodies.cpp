#include "reference/octree_cpu/bodies.hpp"

#include <algorithm>
#include <utility>

namespace broadside::reference {
namespace {

void sort_springs(const core::Scene& scene, Bodies& bodies) {
  bodies.springs = scene.springs;
  if (bodies.springs.empty()) return;
  std::stable_sort(bodies.springs.begin(), bodies.springs.end(),
                   [](const core::Spring& p, const core::Spring& q) { return p.body < q.body; });
  bodies.spring_begin.assign(scene.bodies.size() + 1, 0);
  for (const core::Spring& s : bodies.springs) ++bodies.spring_begin[s.body + 1];
  for (std::size_t i = 1; i < bodies.spring_begin.size(); ++i) bodies.spring_begin[i] += bodies.spring_begin[i - 1];
}

}  // namespace

Bodies make_bodies(const core::Scene& scene) {
  Bodies bodies;
  core::ShapeTable table = core::build_shapes(scene);
  for (core::Shape& shape : table.shapes) {
    const core::NodeBoxes boxes = core::node_boxes(shape.octree);
    bodies.shapes.push_back({std::move(shape), boxes});
  }
  bodies.shape = std::move(table.shape_of_body);
  for (const core::Body& body : scene.bodies) {
    bodies.state.push_back({body.position, body.velocity});
    bodies.inverse_mass.push_back(body.inverse_mass);
    bodies.material.push_back(body.material);
    bodies.is_static.push_back(body.inverse_mass > 0.0F ? 0 : 1);
  }
  sort_springs(scene, bodies);
  bodies.boxes.resize(bodies.state.size());
  bodies.detected.resize(bodies.state.size());
  return bodies;
}

}  // namespace broadside::reference

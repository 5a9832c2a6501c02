#include "reference/octree_cpu/bodies.hpp"

#include <utility>

#include "core/scene/springs_of_bodies.hpp"

namespace broadside::reference {

Bodies make_bodies(const core::Scene& scene) {
  Bodies bodies;
  core::ShapeTable table = core::build_shapes(scene);
  for (core::Shape& shape : table.shapes) {
    const core::NodeBoxes boxes = core::node_boxes(shape.octree);
    VertexBlocks blocks = make_vertex_blocks(shape.octree);
    bodies.shapes.push_back({std::move(shape), boxes, std::move(blocks)});
  }
  bodies.shape = std::move(table.shape_of_body);
  for (const core::Body& body : scene.bodies) {
    bodies.state.push_back({body.position, body.velocity});
    bodies.inverse_mass.push_back(body.inverse_mass);
    bodies.material.push_back(body.material);
    bodies.is_static.push_back(body.inverse_mass > 0.0F ? 0 : 1);
  }
  core::SpringsOfBodies sorted = core::springs_of_bodies(scene);
  bodies.springs = std::move(sorted.springs);
  bodies.spring_begin = std::move(sorted.begin);
  bodies.boxes.resize(bodies.state.size());
  bodies.detected.resize(bodies.state.size());
  return bodies;
}

}  // namespace broadside::reference

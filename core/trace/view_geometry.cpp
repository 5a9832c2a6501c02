#include "core/trace/view_geometry.hpp"

#include "core/scene/shapes.hpp"

namespace broadside::core {
namespace {

Vec3 corner_of(const Box& box, const std::uint8_t (&which)[3]) {
  return {which[0] != 0 ? box.max.x : box.min.x, which[1] != 0 ? box.max.y : box.min.y,
          which[2] != 0 ? box.max.z : box.min.z};
}

}  // namespace

ViewGeometry::ViewGeometry(const Scene& scene, ViewOf of) : is_boxes_(of == ViewOf::kBoxes) {
  if (is_boxes_) {
    topology_ = box_topology(scene.bodies.size());
    return;
  }
  topology_.cell = of == ViewOf::kMeshes ? VtkCell::kTriangle : VtkCell::kHexahedron;
  const ShapeTable table = build_shapes(scene);
  for (std::uint32_t b = 0; b < scene.body_count(); ++b) {
    const Shape& shape = table.shapes[table.shape_of_body[b]];
    if (of == ViewOf::kMeshes) {
      add_mesh(b, *scene.meshes[shape.mesh], shape.octree);
      continue;
    }
    const int level = of == ViewOf::kLevel1 ? 1 : 2;
    for (int k = 0; k < kLevelSize[level]; ++k)
      if (const Box& box = shape.octree.boxes[kLevelOffset[level] + k]; !is_empty(box)) add_box(b, box);
  }
  topology_.points = local_.size();
}

void ViewGeometry::add_box(std::uint32_t body, const Box& box) {
  for (const auto& corner : kHexahedronCorners) {
    topology_.connectivity.push_back(static_cast<std::int64_t>(local_.size()));
    local_.push_back(corner_of(box, corner));
    body_of_.push_back(body);
  }
  topology_.body.push_back(body);
}

void ViewGeometry::add_mesh(std::uint32_t body, const Mesh& mesh, const BodyOctree& octree) {
  const auto first = static_cast<std::int64_t>(local_.size());
  local_.resize(local_.size() + mesh.vertices.size());
  body_of_.resize(local_.size(), body);
  for (std::size_t k = 0; k < octree.sorted_indices.size(); ++k)
    local_[static_cast<std::size_t>(first) + octree.sorted_indices[k]] = octree.sorted_vertices[k];
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) topology_.connectivity.push_back(first + v);
    topology_.body.push_back(body);
  }
}

std::vector<Vec3> ViewGeometry::points(const FrameRecord& frame) const {
  std::vector<Vec3> points;
  points.reserve(topology_.points);
  if (is_boxes_) {
    for (const auto& corner : kHexahedronCorners)
      for (const Box& box : frame.boxes) points.push_back(corner_of(box, corner));
    return points;
  }
  for (std::size_t k = 0; k < local_.size(); ++k) points.push_back(local_[k] + frame.detected_position[body_of_[k]]);
  return points;
}

}  // namespace broadside::core

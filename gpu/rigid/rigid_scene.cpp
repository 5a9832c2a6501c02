#include "gpu/rigid/rigid_scene.hpp"

#include <algorithm>
#include <span>

#include "core/contact.hpp"
#include "core/method/rigid/hull_climb.hpp"

namespace broadside::gpu {
namespace {

std::uint32_t corners_of(const core::HullView& hull) {
  std::uint32_t end = 0;
  for (std::uint32_t k = 0; k < hull.face_count; ++k)
    end = std::max(end, hull.faces[k].first_corner + hull.faces[k].corner_count);
  return end;
}

}  // namespace

RigidScene::Places RigidScene::add_tables(const core::RigidShape& shape) {
  const core::HullView& hull = shape.contact.hull;
  const core::MeshView& mesh = shape.contact.mesh;
  Places at;
  at.vertices = hull.vertex_count > 0 ? vectors_.add({hull.vertices, hull.vertex_count})
                                      : vectors_.add({mesh.vertices, mesh.vertex_count});
  at.faces = faces_.add({hull.faces, hull.face_count});
  at.corners = indices_.add({hull.corners, corners_of(hull)});
  at.edges = edges_.add({hull.edges, hull.edge_count});
  if (hull.ways != nullptr) {
    const std::uint32_t guide_size = core::kGuideStarts + hull.vertex_count + 1;
    at.ways = ways_.add({hull.ways, hull.guide[guide_size - 1]});
    at.guide = indices_.add({hull.guide, guide_size});
  }
  at.beyond = indices_.add({hull.beyond, hull.beyond == nullptr ? 0 : corners_of(hull)});
  at.triangles = indices_.add({mesh.triangles, 3 * std::size_t{mesh.triangle_count}});
  at.normals = vectors_.add({mesh.normals, mesh.triangle_count});
  at.least_facing = numbers_.add({mesh.least_facing, mesh.triangle_count});
  at.nodes = nodes_.add({mesh.nodes, mesh.node_count});
  at.tree_boxes = boxes_.add(shape.octree.boxes);
  at.leaf_begin = indices_.add(shape.octree.leaf_begin);
  at.tree_vertices = vectors_.add(shape.octree.sorted_vertices);
  at.levels = levels_.add({&shape.nodes, 1});
  return at;
}

core::Status RigidScene::upload_tables() {
  BROADSIDE_TRY(vectors_.upload("shapes"));
  BROADSIDE_TRY(indices_.upload("shapes"));
  BROADSIDE_TRY(numbers_.upload("shapes"));
  BROADSIDE_TRY(faces_.upload("shapes"));
  BROADSIDE_TRY(edges_.upload("shapes"));
  BROADSIDE_TRY(ways_.upload("shapes"));
  BROADSIDE_TRY(nodes_.upload("shapes"));
  BROADSIDE_TRY(boxes_.upload("shapes"));
  return levels_.upload("shapes");
}

RigidShapeView RigidScene::view_of(const core::RigidShape& shape, const Places& at) const {
  RigidShapeView view;
  view.contact = shape.contact;
  core::HullView& hull = view.contact.hull;
  hull.vertices = vectors_.at(at.vertices);
  hull.faces = faces_.at(at.faces);
  hull.corners = indices_.at(at.corners);
  hull.edges = edges_.at(at.edges);
  if (hull.ways != nullptr) hull.ways = ways_.at(at.ways);
  if (hull.guide != nullptr) hull.guide = indices_.at(at.guide);
  if (hull.beyond != nullptr) hull.beyond = indices_.at(at.beyond);
  core::MeshView& mesh = view.contact.mesh;
  mesh.vertices = vectors_.at(at.vertices);
  mesh.triangles = indices_.at(at.triangles);
  mesh.normals = vectors_.at(at.normals);
  mesh.least_facing = numbers_.at(at.least_facing);
  mesh.nodes = nodes_.at(at.nodes);
  view.nodes = levels_.at(at.levels);
  view.vertices = {boxes_.at(at.tree_boxes) + core::kLevelOffset[1], boxes_.at(at.tree_boxes) + core::kLevelOffset[2],
                   indices_.at(at.leaf_begin), vectors_.at(at.tree_vertices)};
  view.balls = shape.balls;
  view.half_thickness_m = shape.half_thickness_m;
  return view;
}

core::Status RigidScene::load(const core::Scene& scene, const core::RigidBodies& bodies) {
  vectors_.clear();
  indices_.clear();
  numbers_.clear();
  faces_.clear();
  edges_.clear();
  ways_.clear();
  nodes_.clear();
  boxes_.clear();
  levels_.clear();
  std::vector<Places> places;
  for (const core::RigidShape& shape : bodies.shapes) places.push_back(add_tables(shape));
  BROADSIDE_TRY(upload_tables());
  std::vector<RigidShapeView> shapes;
  for (std::size_t k = 0; k < places.size(); ++k) shapes.push_back(view_of(bodies.shapes[k], places[k]));
  std::vector<core::ContactShape> face_shapes;
  std::vector<core::ContactPose> face_poses;
  for (int face = 0; face < core::kFaceCount; ++face) {
    face_shapes.push_back(core::domain_face_shape(face));
    face_poses.push_back(core::domain_face_pose(scene.domain, face));
  }
  has_wrenches_ = !bodies.wrench.empty();
  BROADSIDE_TRY(shapes_.upload(shapes, "shapes"));
  BROADSIDE_TRY(shape_of_body_.upload(bodies.shape, "bodies"));
  BROADSIDE_TRY(is_swept_.upload(bodies.is_swept, "bodies"));
  BROADSIDE_TRY(mass_.upload(bodies.mass, "bodies"));
  BROADSIDE_TRY(material_.upload(bodies.material, "bodies"));
  BROADSIDE_TRY(wrench_.upload(bodies.wrench, "wrenches"));
  BROADSIDE_TRY(face_shapes_.upload(face_shapes, "faces"));
  return face_poses_.upload(face_poses, "faces");
}

void RigidScene::fill(RigidFrameView& view) const {
  view.shapes = shapes_.data();
  view.shape_of_body = shape_of_body_.data();
  view.is_swept = is_swept_.data();
  view.mass = mass_.data();
  view.material = material_.data();
  view.wrench = has_wrenches_ ? wrench_.data() : nullptr;
  view.face_shapes = face_shapes_.data();
  view.face_poses = face_poses_.data();
}

std::uint64_t RigidScene::bytes() const {
  return vectors_.bytes() + indices_.bytes() + numbers_.bytes() + faces_.bytes() + edges_.bytes() + ways_.bytes() +
         nodes_.bytes() + boxes_.bytes() + levels_.bytes() + shapes_.bytes() + shape_of_body_.bytes() +
         is_swept_.bytes() + mass_.bytes() + material_.bytes() + wrench_.bytes() + face_shapes_.bytes() +
         face_poses_.bytes();
}

}  // namespace broadside::gpu

#include "bench/cli/seen_body.hpp"

#include <algorithm>

#include "bench/cli/picture_plane.hpp"
#include "core/scene/hull_faces.hpp"
#include "core/scene/primitive.hpp"

namespace broadside::bench {
namespace {

using reports::plots::Projected;

// The cosine of a fifth of a degree: a smaller difference in direction is not visible.
constexpr float kSameWay = 0.99999F;

SeenShape seen_shape(const core::Mesh& mesh) {
  SeenShape shape;
  shape.is_convex = core::is_convex(mesh);
  if (!shape.is_convex) {
    shape.vertices = mesh.vertices;
    for (const core::Triangle& t : mesh.triangles) shape.polygons.push_back({t[0], t[1], t[2]});
    return shape;
  }
  core::HullTables tables = core::hull_tables(mesh);
  std::vector<core::Vec3> normals;
  for (const core::HullFace& face : tables.faces) {
    const auto first = tables.corners.begin() + face.first_corner;
    shape.polygons.emplace_back(first, first + face.corner_count);
    // Faces of a convex body with the same normal lie in one plane.
    std::uint32_t plane = 0;
    while (plane < normals.size() && core::dot(normals[plane], face.normal) < kSameWay) ++plane;
    if (plane == normals.size()) normals.push_back(face.normal);
    shape.plane_of.push_back(plane);
  }
  shape.vertices = std::move(tables.vertices);
  return shape;
}

// Twice the area of a, b, c in the plane; positive when they go anticlockwise.
double doubled_area(const Projected& a, const Projected& b, const Projected& c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

}  // namespace

std::vector<SeenShape> seen_shapes(const core::Scene& scene) {
  std::vector<SeenShape> shapes;
  for (const auto& mesh : scene.meshes) shapes.push_back(seen_shape(*mesh));
  return shapes;
}

SeenBody::SeenBody(const SeenShape& of, core::Vec3 position, core::Quat orientation)
    : shape(&of), box(core::empty_box()) {
  for (const core::Vec3& v : of.vertices) {
    vertices.push_back(position + core::rotate(orientation, v));
    points.push_back(reports::plots::project(vertices.back(), kPictureView));
    box = core::grown(box, vertices.back());
  }
}

bool SeenBody::faces_eye(std::span<const std::uint32_t> polygon) const {
  double area = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k)
    area += doubled_area(points[polygon[0]], points[polygon[k - 1]], points[polygon[k]]);
  return area > 0.0;
}

std::vector<Projected> outline_of(std::vector<Projected> points) {
  std::sort(points.begin(), points.end(),
            [](const Projected& a, const Projected& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<Projected> outline;
  // The lower side from left to right, then the upper one back.
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = outline.size();
    for (const Projected& p : points) {
      while (outline.size() >= first + 2 && doubled_area(outline[outline.size() - 2], outline.back(), p) <= 0.0)
        outline.pop_back();
      outline.push_back(p);
    }
    if (!outline.empty()) outline.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return outline;
}

}  // namespace broadside::bench

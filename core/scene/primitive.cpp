#include "core/scene/primitive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/exact/triangle_distance.hpp"

namespace broadside::core {
namespace {

// A vertex coordinate is its formula rounded to float once, and a distance has a few such roundings: 8 of 2^-24.
constexpr double kOnSurface = 8.0 * 0x1p-24;
// The facets of a mesh lie inside the true surface. With a limit of 5 %, a sphere needs some 80 of them; an icosahedron
// (20 %) counts as a polyhedron of its own.
constexpr double kMostGap = 0.05;

using exact::Point;
using exact::to_point;

double along(Point p, int axis) {
  return axis == 0 ? p.x : (axis == 1 ? p.y : p.z);
}

// Whether every edge belongs to two triangles, once in each direction.
bool is_closed(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
  return std::all_of(edges.begin(), edges.end(), [&](const auto& e) {
    return std::binary_search(edges.begin(), edges.end(), std::pair{e.second, e.first});
  });
}

bool is_centered(const Box& b, double size) {
  for (int k = 0; k < 3; ++k)
    if (std::abs(static_cast<double>(b.min[k]) + b.max[k]) > kOnSurface * size) return false;
  return true;
}

bool is_box(const Mesh& mesh, const Box& b) {
  std::array<bool, 8> has_corner{};
  for (const Vec3 v : mesh.vertices) {
    unsigned corner = 0;
    int on_faces = 0;
    for (int k = 0; k < 3; ++k) {
      on_faces += v[k] == b.min[k] || v[k] == b.max[k] ? 1 : 0;
      corner |= v[k] == b.max[k] ? 1U << static_cast<unsigned>(k) : 0U;
    }
    if (on_faces == 0) return false;
    if (on_faces == 3) has_corner[corner] = true;
  }
  if (!std::all_of(has_corner.begin(), has_corner.end(), [](bool has) { return has; })) return false;
  // Requires triangles that cover the faces and nothing else: their area is the box's, and each lies in a face.
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Point p = to_point(mesh.vertices[t[0]]);
    area += 0.5 * length(cross(to_point(mesh.vertices[t[1]]) - p, to_point(mesh.vertices[t[2]]) - p));
  }
  const Point s = to_point(b.max) - to_point(b.min);
  const double whole = 2.0 * (s.x * s.y + s.y * s.z + s.z * s.x);
  return std::abs(area - whole) <= 1e-5 * whole;
}

double distance_to_axis_segment(Point p, int axis, double half_length) {
  Point d = p;
  (axis == 0 ? d.x : (axis == 1 ? d.y : d.z)) -= std::clamp(along(p, axis), -half_length, half_length);
  return length(d);
}

// A ball swept along a segment on an axis; a sphere when the segment has no length. Returns the facet gap, or nothing
// when the mesh is not such a shape.
std::optional<double> swept_ball_gap(const Mesh& mesh, int axis, double half_length, double radius) {
  const double size = radius + half_length;
  for (const Vec3 v : mesh.vertices)
    if (std::abs(distance_to_axis_segment(to_point(v), axis, half_length) - radius) > kOnSurface * size)
      return std::nullopt;
  // The true surface bulges out between vertices, most in the middle of a facet or of an edge.
  double least = radius;
  for (const Triangle& t : mesh.triangles) {
    const Point a = to_point(mesh.vertices[t[0]]);
    const Point b = to_point(mesh.vertices[t[1]]);
    const Point c = to_point(mesh.vertices[t[2]]);
    for (const Point middle : {(1.0 / 3.0) * (a + b + c), 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)})
      least = std::min(least, distance_to_axis_segment(middle, axis, half_length));
  }
  const double gap = radius - least;
  return gap <= kMostGap * radius ? std::optional(gap) : std::nullopt;
}

// Recognizes a cylinder about an axis: every triangle lies in one of its two ends or has its corners on its side.
// Returns the primitive, or nothing when the mesh is not such a shape.
std::optional<Primitive> cylinder(const Mesh& mesh, int axis, Vec3 half) {
  // The distance from an axis segment that is practically infinite.
  const auto from_axis = [axis](Point p) { return distance_to_axis_segment(p, axis, 1e30); };
  const double length_m = half[axis];
  double radius = 0.0;
  for (const Vec3 v : mesh.vertices) radius = std::max(radius, from_axis(to_point(v)));
  const double off = kOnSurface * (radius + length_m);
  double least = radius;
  for (const Triangle& t : mesh.triangles) {
    const std::array<Point, 3> p{to_point(mesh.vertices[t[0]]), to_point(mesh.vertices[t[1]]),
                                 to_point(mesh.vertices[t[2]])};
    const auto is_in_end = [&](double end) {
      return std::all_of(p.begin(), p.end(), [&](Point q) { return std::abs(along(q, axis) - end) <= off; });
    };
    if (is_in_end(length_m) || is_in_end(-length_m)) continue;
    for (const Point q : p)
      if (std::abs(from_axis(q) - radius) > off) return std::nullopt;
    for (const Point middle :
         {(1.0 / 3.0) * (p[0] + p[1] + p[2]), 0.5 * (p[0] + p[1]), 0.5 * (p[1] + p[2]), 0.5 * (p[2] + p[0])})
      least = std::min(least, from_axis(middle));
  }
  if (radius - least > kMostGap * radius) return std::nullopt;
  const auto r = static_cast<float>(radius);
  Vec3 extents{r, r, r};
  extents[axis] = half[axis];
  return Primitive{PrimitiveKind::kCylinder, extents, r, axis, radius - least};
}

}  // namespace

std::string_view primitive_word(PrimitiveKind kind) {
  switch (kind) {
    case PrimitiveKind::kBox:
      return "box";
    case PrimitiveKind::kSphere:
      return "sphere";
    case PrimitiveKind::kCapsule:
      return "capsule";
    case PrimitiveKind::kCylinder:
      return "cylinder";
  }
  return "unknown";
}

std::optional<Primitive> primitive_of(const Mesh& mesh) {
  if (mesh.vertices.size() < 8 || mesh.triangles.size() < 12) return std::nullopt;
  const Box b = bounds(mesh);
  const Vec3 half = 0.5F * (b.max - b.min);
  const float size = std::max({half.x, half.y, half.z});
  const float least = std::min({half.x, half.y, half.z});
  if (!(least > 0.0F) || !is_centered(b, size)) return std::nullopt;
  if (is_box(mesh, b)) return Primitive{PrimitiveKind::kBox, half, 0.0F, 0, 0.0};
  if (!is_closed(mesh)) return std::nullopt;

  // A sphere's vertices need not reach the ends of its axes, so the radius is that of the vertices.
  float radius = 0.0F;
  for (const Vec3 v : mesh.vertices) radius = std::max(radius, static_cast<float>(length(to_point(v))));
  if (const auto gap = swept_ball_gap(mesh, 0, 0.0, radius))
    return Primitive{PrimitiveKind::kSphere, {radius, radius, radius}, radius, 0, *gap};
  const int axis = half.x == size ? 0 : (half.y == size ? 1 : 2);
  const float thick = half[(axis + 1) % 3];
  if (const auto gap = swept_ball_gap(mesh, axis, size - thick, thick)) {
    Vec3 extents{thick, thick, thick};
    extents[axis] = size;
    return Primitive{PrimitiveKind::kCapsule, extents, thick, axis, *gap};
  }
  for (int k = 0; k < 3; ++k)
    if (auto found = cylinder(mesh, k, half)) return found;
  return std::nullopt;
}

bool is_convex(const Mesh& mesh) {
  if (mesh.vertices.size() < 4 || !is_closed(mesh)) return false;
  const Box b = bounds(mesh);
  const double size = length(to_point(b.max) - to_point(b.min));
  for (const Triangle& t : mesh.triangles) {
    const Point a = to_point(mesh.vertices[t[0]]);
    const Point normal = cross(to_point(mesh.vertices[t[1]]) - a, to_point(mesh.vertices[t[2]]) - a);
    const double scale = length(normal);
    if (!(scale > 0.0)) continue;
    for (const Vec3 v : mesh.vertices)
      if (dot(to_point(v) - a, normal) > 4.0 * kOnSurface * size * scale) return false;
  }
  return true;
}

}  // namespace broadside::core

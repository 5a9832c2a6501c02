#include "core/exact/convex_core.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scene/primitive.hpp"

namespace broadside::exact {
namespace {

// Directions closer to parallel than this count as one direction. The axis between them would consist of rounding
// alone, and leaving it out changes a depth of 1 m by less than 1e-9 m.
constexpr double kParallel = 1e-9;
// Below this length, a direction between nearest points consists of rounding, m.
constexpr double kNoDirection = 1e-12;

Point unit(Point p) {
  return (1.0 / length(p)) * p;
}

bool is_parallel(Point p, Point q) {
  const Point c = cross(p, q);
  return dot(c, c) <= kParallel * kParallel;
}

void add_direction(std::vector<Point>& directions, Point p, bool keeps_sign) {
  const bool is_known = std::any_of(directions.begin(), directions.end(),
                                    [&](Point q) { return is_parallel(p, q) && (!keeps_sign || dot(p, q) > 0.0); });
  if (!is_known) directions.push_back(p);
}

void describe(ConvexCore& core) {
  for (const auto& [i, j] : core.edges) {
    const Point d = core.vertices[j] - core.vertices[i];
    if (length(d) > 0.0) add_direction(core.directions, unit(d), false);
  }
  for (const auto& f : core.faces) {
    const Point n = cross(core.vertices[f[1]] - core.vertices[f[0]], core.vertices[f[2]] - core.vertices[f[0]]);
    if (length(n) > 0.0) add_direction(core.normals, unit(n), true);
  }
}

ConvexCore polytope(const core::Mesh& mesh) {
  ConvexCore core;
  for (const core::Vec3 v : mesh.vertices) core.vertices.push_back(to_point(v));
  for (const core::Triangle& t : mesh.triangles) {
    core.faces.push_back({t[0], t[1], t[2]});
    for (int k = 0; k < 3; ++k) core.edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  }
  std::sort(core.edges.begin(), core.edges.end());
  core.edges.erase(std::unique(core.edges.begin(), core.edges.end()), core.edges.end());
  return core;
}

ConvexCore box(core::Vec3 half) {
  ConvexCore core;
  for (unsigned corner = 0; corner < 8; ++corner)
    core.vertices.push_back({(corner & 1U) != 0 ? half.x : -half.x, (corner & 2U) != 0 ? half.y : -half.y,
                             (corner & 4U) != 0 ? half.z : -half.z});
  for (std::uint32_t corner = 0; corner < 8; ++corner)
    for (std::uint32_t bit = 1; bit < 8; bit *= 2)
      if ((corner & bit) == 0) core.edges.emplace_back(corner, corner | bit);
  for (std::uint32_t bit = 1; bit < 8; bit *= 2) {
    const std::uint32_t u = bit == 4 ? 1 : 2 * bit;
    const std::uint32_t w = u == 4 ? 1 : 2 * u;
    // u x w points along +bit, so these triangles face outward.
    core.faces.push_back({bit, bit | u, bit | u | w});
    core.faces.push_back({bit, bit | u | w, bit | w});
    core.faces.push_back({0, u | w, u});
    core.faces.push_back({0, w, u | w});
  }
  return core;
}

ConvexCore rounded(const core::Primitive& p) {
  ConvexCore core;
  core.radius_m = p.radius_m;
  if (p.kind == core::PrimitiveKind::kSphere) {
    core.vertices.push_back({});
    return core;
  }
  const Point end = to_point(core::axis_vector(p.axis, p.half_length_m()));
  core.vertices = {-1.0 * end, end};
  core.edges.emplace_back(0, 1);
  return core;
}

double least_along(const std::vector<Point>& vertices, Point d) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point p : vertices) least = std::min(least, dot(p, d));
  return least;
}

const Point& support(const std::vector<Point>& vertices, Point d) {
  return *std::max_element(vertices.begin(), vertices.end(), [&](Point p, Point q) { return dot(p, d) < dot(q, d); });
}

void try_axis(const ConvexCore& a, const ConvexCore& b, Point d, Axis& best) {
  const double gap = least_along(a.vertices, d) + least_along(b.vertices, -1.0 * d);
  if (gap > best.gap) best = {gap, d};
}

Corners corners_of(const ConvexCore& core, const std::array<std::uint32_t, 3>& face) {
  return {core.vertices[face[0]], core.vertices[face[1]], core.vertices[face[2]]};
}

void keep(Nearest& best, const Nearest& found) {
  if (found.squared_m2 < best.squared_m2) best = found;
}

// Nearest points of the surfaces of two cores. A core may be a segment or a point that stands for a surface.
Nearest nearest_features(const ConvexCore& a, const ConvexCore& b) {
  Nearest best{std::numeric_limits<double>::infinity(), {}, {}};
  for (const Point p : a.vertices) {
    for (const auto& face : b.faces) keep(best, nearest_of_point_and_triangle(p, corners_of(b, face)));
    for (const Point q : b.vertices) keep(best, {dot(p - q, p - q), p, q});
  }
  for (const Point q : b.vertices) {
    for (const auto& face : a.faces) {
      const Nearest found = nearest_of_point_and_triangle(q, corners_of(a, face));
      keep(best, {found.squared_m2, found.on_b, found.on_a});
    }
  }
  for (const auto& [i, j] : a.edges) {
    for (const auto& [k, l] : b.edges)
      keep(best, nearest_of_segments(a.vertices[i], a.vertices[j], b.vertices[k], b.vertices[l]));
    for (const Point q : b.vertices) keep(best, nearest_of_segments(a.vertices[i], a.vertices[j], q, q));
  }
  for (const auto& [k, l] : b.edges)
    for (const Point p : a.vertices) keep(best, nearest_of_segments(p, p, b.vertices[k], b.vertices[l]));
  return best;
}

// Any direction normal to both segments: every such direction separates cores without faces.
Point across(const ConvexCore& a, const ConvexCore& b) {
  std::vector<Point> along = a.directions;
  along.insert(along.end(), b.directions.begin(), b.directions.end());
  if (along.empty()) return {1.0, 0.0, 0.0};
  if (along.size() > 1 && !is_parallel(along[0], along[1])) return unit(cross(along[0], along[1]));
  const Point d = along[0];
  const Point other = std::abs(d.x) < 0.5 ? Point{1.0, 0.0, 0.0} : Point{0.0, 1.0, 0.0};
  return unit(cross(d, other));
}

SignedDistance with_radii(double gap, Point normal, Point on_a, Point on_b, const ConvexCore& a, const ConvexCore& b) {
  return {gap - a.radius_m - b.radius_m, normal, on_a - a.radius_m * normal, on_b + b.radius_m * normal};
}

}  // namespace

std::optional<ConvexCore> convex_core_of(const core::Mesh& mesh) {
  std::optional<ConvexCore> core;
  const auto primitive = core::primitive_of(mesh);
  if (primitive && primitive->kind == core::PrimitiveKind::kCylinder) return std::nullopt;
  if (primitive)
    core = primitive->kind == core::PrimitiveKind::kBox ? box(primitive->half_extents) : rounded(*primitive);
  else if (core::is_convex(mesh))
    core = polytope(mesh);
  if (core) describe(*core);
  return core;
}

Point Placement::turned(Point p) const {
  const auto [w, x, y, z] = orientation;
  const double scale = 2.0 / (w * w + x * x + y * y + z * z);
  const Point v{x, y, z};
  const Point t = cross(v, p);
  return p + scale * (w * t + cross(v, t));
}

Placement to_placement(const core::Pose& pose) {
  const core::Quat q = pose.orientation;
  return {to_point(pose.position), {q.w, q.x, q.y, q.z}};
}

ConvexCore placed(const ConvexCore& core, const Placement& placement) {
  ConvexCore out = core;
  for (Point& p : out.vertices) p = placement.turned(p) + placement.origin;
  for (Point& n : out.normals) n = placement.turned(n);
  for (Point& d : out.directions) d = placement.turned(d);
  return out;
}

ConvexCore placed(const ConvexCore& core, const core::Pose& pose) {
  return placed(core, to_placement(pose));
}

Axis widest_gap(const ConvexCore& a, const ConvexCore& b) {
  Axis best;
  for (const Point n : a.normals) try_axis(a, b, -1.0 * n, best);
  for (const Point n : b.normals) try_axis(a, b, n, best);
  for (const Point p : a.directions) {
    for (const Point q : b.directions) {
      const Point d = cross(p, q);
      if (dot(d, d) <= kParallel * kParallel) continue;
      try_axis(a, b, unit(d), best);
      try_axis(a, b, -1.0 * unit(d), best);
    }
  }
  return best;
}

SignedDistance signed_distance(const ConvexCore& a, const ConvexCore& b) {
  const Axis axis = widest_gap(a, b);
  const bool has_side = !a.faces.empty() || !b.faces.empty();
  if (has_side && axis.gap <= 0.0)
    return with_radii(axis.gap, axis.direction, support(a.vertices, -1.0 * axis.direction),
                      support(b.vertices, axis.direction), a, b);
  const Nearest near = nearest_features(a, b);
  const double apart = std::sqrt(near.squared_m2);
  if (apart > kNoDirection)
    return with_radii(apart, (1.0 / apart) * (near.on_a - near.on_b), near.on_a, near.on_b, a, b);
  return with_radii(apart, has_side ? axis.direction : across(a, b), near.on_a, near.on_b, a, b);
}

double overlap_along(const ConvexCore& a, const ConvexCore& b, Point direction) {
  return -(least_along(a.vertices, direction) + least_along(b.vertices, -1.0 * direction)) + a.radius_m + b.radius_m;
}

}  // namespace broadside::exact

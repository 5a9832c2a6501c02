// Whether a point is inside a closed mesh, and which point of the surface is nearest to it; by one lane.
//
// A point is inside where a ray from it crosses the surface an odd number of times. Which triangles the ray crosses is
// decided without rounding: coordinates are float32, so in float64 their differences and products are exact, and a sum
// of two of them has the right sign. A ray through an edge counts for exactly one of the edge's two triangles, whatever
// their order, so a ray never slips between triangles. The position of a triangle along the ray is rounded; that
// matters only to points on the surface, whose depth is 0.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/simplex.hpp"

namespace broadside::core {

namespace inside_detail {

inline constexpr int kOpenOfTree = 72;

// Whether the edge passes the point p on the side of larger y, seen along x. The answer is the same whichever end comes
// first.
BROADSIDE_HD bool passes_beside(Vec3 p, Vec3 a, Vec3 b) {
  if ((a.z > p.z) == (b.z > p.z)) return false;
  const Vec3 low = a.z > p.z ? b : a;
  const Vec3 high = a.z > p.z ? a : b;
  const double y0 = static_cast<double>(low.y) - static_cast<double>(p.y);
  const double z0 = static_cast<double>(low.z) - static_cast<double>(p.z);
  const double y1 = static_cast<double>(high.y) - static_cast<double>(p.y);
  const double z1 = static_cast<double>(high.z) - static_cast<double>(p.z);
  return y0 * z1 > y1 * z0;
}

// Whether the ray from p along +x crosses the triangle.
BROADSIDE_HD bool crosses(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const bool is_over = (passes_beside(p, a, b) != passes_beside(p, b, c)) != passes_beside(p, c, a);
  if (!is_over) return false;
  const double ux = static_cast<double>(b.x) - static_cast<double>(a.x);
  const double uy = static_cast<double>(b.y) - static_cast<double>(a.y);
  const double uz = static_cast<double>(b.z) - static_cast<double>(a.z);
  const double wx = static_cast<double>(c.x) - static_cast<double>(a.x);
  const double wy = static_cast<double>(c.y) - static_cast<double>(a.y);
  const double wz = static_cast<double>(c.z) - static_cast<double>(a.z);
  const double nx = uy * wz - uz * wy;
  const double ny = uz * wx - ux * wz;
  const double nz = ux * wy - uy * wx;
  const double behind = nx * (static_cast<double>(p.x) - static_cast<double>(a.x)) +
                        ny * (static_cast<double>(p.y) - static_cast<double>(a.y)) +
                        nz * (static_cast<double>(p.z) - static_cast<double>(a.z));
  return nx > 0.0 ? behind < 0.0 : behind > 0.0;
}

}  // namespace inside_detail

// p: mesh coordinates. The mesh is closed.
BROADSIDE_HD_CALLED bool is_inside(const MeshView& mesh, Vec3 p) {
  if (p.x < mesh.nodes[0].min.x) return false;  // the whole mesh is at larger x, so p is outside
  std::uint32_t open[inside_detail::kOpenOfTree];
  int count = 0;
  open[count++] = 0;
  bool is_odd = false;
  while (count > 0) {
    const TriangleNode& node = mesh.nodes[open[--count]];
    if (p.x > node.max.x || p.y > node.max.y || p.y < node.min.y || p.z > node.max.z || p.z < node.min.z) continue;
    if (node.count == 0 && count + 2 <= inside_detail::kOpenOfTree) {
      open[count++] = node.first;
      open[count++] = node.first + 1;
    }
    for (std::size_t t = node.first; t < std::size_t{node.first} + node.count; ++t)
      is_odd ^=
          inside_detail::crosses(p, mesh.vertices[mesh.triangles[3 * t]], mesh.vertices[mesh.triangles[3 * t + 1]],
                                 mesh.vertices[mesh.triangles[3 * t + 2]]);
  }
  return is_odd;
}

struct NearestOfMesh {
  Vec3 point;  // mesh coordinates
  float squared_m2 = 3.402823e38F;
  std::uint32_t triangle = 0;
};

namespace inside_detail {

BROADSIDE_HD float squared_to_box(Vec3 p, Vec3 low, Vec3 high) {
  float squared = 0.0F;
  for (int k = 0; k < 3; ++k) {
    const float outside = p[k] < low[k] ? low[k] - p[k] : (p[k] > high[k] ? p[k] - high[k] : 0.0F);
    squared = squared + outside * outside;
  }
  return squared;
}

}  // namespace inside_detail

// The point of the surface nearest to p. The search goes no farther than within_m; if nothing is that near, the
// distance stays the largest number. Of triangles that are equally near, the first is taken.
BROADSIDE_HD_CALLED NearestOfMesh nearest_of_mesh(const MeshView& mesh, Vec3 p, float within_m) {
  NearestOfMesh best;
  float limit = within_m * within_m;
  std::uint32_t open[inside_detail::kOpenOfTree];
  int count = 0;
  open[count++] = 0;
  while (count > 0) {
    const TriangleNode& node = mesh.nodes[open[--count]];
    if (inside_detail::squared_to_box(p, node.min, node.max) > limit) continue;
    if (node.count == 0 && count + 2 <= inside_detail::kOpenOfTree) {
      const TriangleNode& first = mesh.nodes[node.first];
      const TriangleNode& second = mesh.nodes[node.first + 1];
      const bool first_is_nearer = inside_detail::squared_to_box(p, first.min, first.max) <=
                                   inside_detail::squared_to_box(p, second.min, second.max);
      open[count++] = node.first + (first_is_nearer ? 1U : 0U);
      open[count++] = node.first + (first_is_nearer ? 0U : 1U);
    }
    for (std::uint32_t t = node.first; t < node.first + node.count; ++t) {
      Simplex s;
      s.count = 3;
      for (std::uint32_t k = 0; k < 3; ++k) s.corners[k] = mesh.vertices[mesh.triangles[3 * t + k]] - p;
      float inside_m = 0.0F;
      const Vec3 x = keep_nearest(s, inside_m);
      const float squared = dot(x, x);
      const bool is_nearer = squared < best.squared_m2 || (squared == best.squared_m2 && t < best.triangle);
      if (!(squared <= limit) || !is_nearer) continue;
      best = {p + x, squared, t};
      limit = squared;
    }
  }
  return best;
}

}  // namespace broadside::core

// Meshes that are not convex, against each other, convex shapes and planes.
//
// A tree over the triangles finds those that are near. Each triangle is a sheet with two faces and is treated like any
// polytope. For a pair of triangles, only contacts in front of both are kept: the normal must lie between a triangle's
// own normal and those of the triangles beyond its convex edges, so that the inner edges of a smooth surface make no
// contacts. Where closed meshes overlap by more than the size of their triangles, sheets no longer find the overlap;
// there, vertices inside the other mesh are points, with the shortest way out. Points are merged into patches by
// normal, the deepest first.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/method/rigid/capsule_manifold.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cylinder_manifold.hpp"
#include "core/method/rigid/lanes.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/mesh_inside.hpp"
#include "core/method/rigid/mesh_touches.hpp"
#include "core/method/rigid/polytope_axes.hpp"
#include "core/method/rigid/polytope_manifold.hpp"
#include "core/method/rigid/polytopes.hpp"

namespace broadside::core {

namespace mesh_detail {

BROADSIDE_HD TrianglePolytope triangle_polytope(const PlacedShape& mesh, std::uint32_t t) {
  const MeshView& view = mesh.shape->mesh;
  TrianglePolytope out;
  for (std::uint32_t k = 0; k < 3; ++k)
    out.corners[k] = mesh.center + turned(mesh.axes, view.vertices[view.triangles[3 * t + k]]);
  out.center = (1.0F / 3.0F) * (out.corners[0] + out.corners[1] + out.corners[2]);
  out.normal = turned(mesh.axes, view.normals[t]);
  return out;
}

// The least cosine between a triangle's normal and a direction in which its surface looks, from MeshView::least_facing.
// Directions that are off by the rounding of normals count.
BROADSIDE_HD float least_looking(float least_facing) {
  return fmaxf(least_facing - (1.0F - kSameNormal), 0.0F);
}

// Whether a triangle's surface looks in this direction.
BROADSIDE_HD bool looks(const PlacedShape& mesh, std::uint32_t t, Vec3 normal, Vec3 direction) {
  return dot(normal, direction) >= mesh.shape->mesh.least_facing[t] - (1.0F - kSameNormal) &&
         dot(normal, direction) > 0.0F;
}

// Whether a and b look at each other along some direction. They do when the angle between one normal and the opposite
// of the other is at most the sum of how far both surfaces look aside. The last term allows for much more than the
// error of the normals' lengths.
BROADSIDE_HD bool may_look_at_each_other(float least_a, Vec3 normal_a, float least_b, Vec3 normal_b) {
  const float aside = sqrtf((1.0F - least_a * least_a) * (1.0F - least_b * least_b));
  return -dot(normal_a, normal_b) >= least_a * least_b - aside - 0x1p-14F;
}

// The same for any two triangles of two nodes.
BROADSIDE_HD bool may_look_at_each_other(const PlacedShape& a, const TriangleNode& of_a, const PlacedShape& b,
                                         const TriangleNode& of_b) {
  if (of_a.least_looking < 0.0F || of_b.least_looking < 0.0F) return true;
  return may_look_at_each_other(of_a.least_looking, turned(a.axes, of_a.looking), of_b.least_looking,
                                turned(b.axes, of_b.looking));
}

// Whether boxes of two nodes are apart by more than reach_m along an axis of either body. Six of the fifteen axes are
// enough: a pair that is kept in vain costs only time.
BROADSIDE_HD bool are_apart(const PlacedShape& a, Vec3 center_a, Vec3 half_a, const PlacedShape& b, Vec3 center_b,
                            Vec3 half_b, float reach_m) {
  const Vec3 d = (a.center + turned(a.axes, center_a)) - (b.center + turned(b.axes, center_b));
  for (int i = 0; i < 3; ++i) {
    float reach_a = half_a[i];
    float reach_b = half_b[i];
    for (int j = 0; j < 3; ++j) {
      reach_a += fabsf(dot(a.axes[i], b.axes[j])) * half_b[j];
      reach_b += fabsf(dot(b.axes[i], a.axes[j])) * half_a[j];
    }
    if (fabsf(dot(a.axes[i], d)) > reach_a + reach_m || fabsf(dot(b.axes[i], d)) > reach_b + reach_m) return true;
  }
  return false;
}

// Depth of a tree is at most 32 levels, and a visit leaves at most one open node a level.
inline constexpr int kOpenNodes = 72;

BROADSIDE_HD std::uint32_t key_in_mesh(std::uint32_t key, std::uint32_t triangle) {
  return feature_key(key, triangle + 1);
}

// Drops the manifold of a body and one triangle if the triangle's surface does not look along the normal.
BROADSIDE_HD void keep_if_seen(Manifold& m, const PlacedShape& mesh, std::uint32_t t, Vec3 normal) {
  if (m.count > 0 && !looks(mesh, t, normal, m.normal)) m.count = 0;
  for (int k = 0; k < m.count; ++k) m.points[k].feature = key_in_mesh(m.points[k].feature, t);
}

// A convex body (A) and one triangle.
template <typename Polytope>
BROADSIDE_HD_CALLED void against_triangle(const Polytope& a, float ball_m, const PlacedShape& mesh, std::uint32_t t,
                                          float rounding_m, float reach_m, Manifold& m) {
  const TrianglePolytope triangle = triangle_polytope(mesh, t);
  const SeparatingAxis axis = separating_axis(a, triangle, rounding_m, reach_m + ball_m);
  polytope_manifold(a, triangle, axis, ball_m, 0.0F, rounding_m, reach_m, m);
  keep_if_seen(m, mesh, t, triangle.normal);
}

// A cylinder (A) and one triangle. The triangle is treated as a hull of two faces, so that the cylinder is round here
// too.
BROADSIDE_HD_CALLED void cylinder_against_triangle(const PlacedShape& a, const PlacedShape& mesh, std::uint32_t t,
                                                   float rounding_m, float reach_m, Manifold& m) {
  const TrianglePolytope triangle = triangle_polytope(mesh, t);
  const std::uint32_t corners[6] = {0, 1, 2, 0, 2, 1};
  const HullEdge edges[3] = {{0, 1, 0, 1}, {1, 2, 0, 1}, {2, 0, 0, 1}};
  Vec3 vertices[3];
  for (int k = 0; k < 3; ++k) vertices[k] = triangle.corners[k] - triangle.center;
  const float offset_m = dot(triangle.normal, vertices[0]);
  const HullFace faces[2] = {{triangle.normal, offset_m, 0, 3}, {-triangle.normal, -offset_m, 3, 3}};
  ContactShape sheet;
  sheet.kind = ContactKind::kHull;
  sheet.hull = {vertices, faces, corners, edges, nullptr, nullptr, nullptr, 3, 2, 3};
  const PlacedShape placed{&sheet, triangle.center, turned_axes({})};
  cylinder_manifold<OneLane>(a, placed, rounding_m, reach_m, m);
  keep_if_seen(m, mesh, t, triangle.normal);
}

struct PointPolytope {
  using Lanes = OneLane;
  static constexpr int kMostFaceCorners = 1;
  static constexpr bool kIsSheet = false;
  Vec3 center;

  BROADSIDE_HD int corner_count() const { return 1; }
  BROADSIDE_HD int edge_count() const { return 0; }
  BROADSIDE_HD int face_count() const { return 0; }
  BROADSIDE_HD Vec3 corner(int) const { return center; }
  BROADSIDE_HD void edge(int, int& from, int& to) const { from = to = 0; }
  BROADSIDE_HD void edge_faces(int, int& left, int& right) const { left = right = 0; }
  BROADSIDE_HD Vec3 face_normal(int) const { return {}; }
  BROADSIDE_HD float face_height(int) const { return 0.0F; }
  BROADSIDE_HD Vec3 local_point(Vec3 x) const { return x; }
  BROADSIDE_HD float height_over(int k, Vec3 x) const { return dot(face_normal(k), x) - face_height(k); }
  BROADSIDE_HD Vec3 local(Vec3 direction) const { return direction; }
  BROADSIDE_HD float height(int, Vec3 direction) const { return dot(direction, center); }
  BROADSIDE_HD int face_corner_count(int) const { return 1; }
  BROADSIDE_HD int face_corner(int, int) const { return 0; }
  BROADSIDE_HD float least(Vec3 direction) const { return dot(direction, center); }
  BROADSIDE_HD float least_at(int, Vec3 direction) const { return dot(direction, center); }
  BROADSIDE_HD int support_face(Vec3) const { return 0; }
};

BROADSIDE_HD Vec3 half_of(const ContactShape& s) {
  if (s.kind == ContactKind::kBox) return s.half;
  if (s.kind == ContactKind::kHull) return {s.size_m, s.size_m, s.size_m};
  Vec3 half{s.radius_m, s.radius_m, s.radius_m};
  if (s.kind == ContactKind::kCapsule) half[s.axis] = s.radius_m + s.half_length_m;
  if (s.kind == ContactKind::kCylinder) half[s.axis] = s.half_length_m;
  return half;
}

template <typename Lanes>
BROADSIDE_HD_CALLED void convex_against(const PlacedShape& a, const PlacedShape& mesh, float rounding_m, float reach_m,
                                        Touches& out) {
  const Vec3 half = half_of(*a.shape);
  const auto open = [&](NodePair pair, NodePair(&below)[2]) {
    const TriangleNode& node = mesh.shape->mesh.nodes[pair.a];
    const float seen_m = out.seen_m(reach_m, rounding_m);
    if (are_apart(mesh, 0.5F * (node.min + node.max), 0.5F * (node.max - node.min), a, {}, half, seen_m)) return 0;
    if (node.count > 0) return Lanes::kLeaf;
    below[0] = {node.first, 0};
    below[1] = {node.first + 1, 0};
    return 2;
  };
  const auto items = [&](NodePair pair) { return static_cast<int>(mesh.shape->mesh.nodes[pair.a].count); };
  const auto measure = [&](NodePair pair, int item) {
    const std::uint32_t t = mesh.shape->mesh.nodes[pair.a].first + static_cast<std::uint32_t>(item);
    const float radius_m = a.shape->radius_m;
    Manifold m;
    switch (a.shape->kind) {
      case ContactKind::kSphere:
        against_triangle(PointPolytope{a.center}, radius_m, mesh, t, rounding_m, reach_m, m);
        break;
      case ContactKind::kCapsule:
        against_triangle(segment_polytope(a), radius_m, mesh, t, rounding_m, reach_m, m);
        break;
      case ContactKind::kBox:
        against_triangle(box_polytope(a), 0.0F, mesh, t, rounding_m, reach_m, m);
        break;
      case ContactKind::kCylinder:
        cylinder_against_triangle(a, mesh, t, rounding_m, reach_m, m);
        break;
      default:
        against_triangle(hull_polytope(a), 0.0F, mesh, t, rounding_m, reach_m, m);
    }
    return m;
  };
  Lanes::walk(open, items, measure, [&](const Manifold& m) { take_all<Lanes>(m, rounding_m, out); });
}

// The manifold of two triangles; no points where they are farther apart than seen_m.
BROADSIDE_HD_CALLED void triangles_touch(const PlacedShape& a, std::uint32_t i, const PlacedShape& b, std::uint32_t j,
                                         float rounding_m, float reach_m, float seen_m, Manifold& m) {
  const TrianglePolytope of_a = triangle_polytope(a, i);
  const TrianglePolytope of_b = triangle_polytope(b, j);
  m.count = 0;
  if (!may_look_at_each_other(least_looking(a.shape->mesh.least_facing[i]), of_a.normal,
                              least_looking(b.shape->mesh.least_facing[j]), of_b.normal))
    return;
  const SeparatingAxis axis = separating_axis(of_a, of_b, rounding_m, seen_m);
  if (axis.gap_m > seen_m) return;
  polytope_manifold(of_a, of_b, axis, 0.0F, 0.0F, rounding_m, reach_m, m);
  if (m.count == 0) return;
  if (!looks(b, j, of_b.normal, m.normal) || !looks(a, i, of_a.normal, -m.normal)) m.count = 0;
  for (int k = 0; k < m.count; ++k) m.points[k].feature = key_in_mesh(key_in_mesh(m.points[k].feature, i), j);
}

// Adds the points of triangles that are no farther apart than ahead_m. Once there is no more room, triangles that are
// farther apart than all kept points are skipped, too.
template <typename Lanes>
BROADSIDE_HD_CALLED void mesh_against(const PlacedShape& a, const PlacedShape& b, float rounding_m, float reach_m,
                                      float ahead_m, Touches& out) {
  const TriangleNode* nodes_a = a.shape->mesh.nodes;
  const TriangleNode* nodes_b = b.shape->mesh.nodes;
  const auto open = [&](NodePair pair, NodePair(&below)[2]) {
    const TriangleNode& node_a = nodes_a[pair.a];
    const TriangleNode& node_b = nodes_b[pair.b];
    const Vec3 half_a = 0.5F * (node_a.max - node_a.min);
    const Vec3 half_b = 0.5F * (node_b.max - node_b.min);
    const float seen_m = out.seen_m(ahead_m, rounding_m);
    if (are_apart(a, 0.5F * (node_a.min + node_a.max), half_a, b, 0.5F * (node_b.min + node_b.max), half_b, seen_m))
      return 0;
    if (!may_look_at_each_other(a, node_a, b, node_b)) return 0;
    if (node_a.count > 0 && node_b.count > 0) return Lanes::kLeaf;
    const bool opens_a = node_b.count > 0 || (node_a.count == 0 && dot(half_a, half_a) >= dot(half_b, half_b));
    for (std::uint32_t k = 0; k < 2; ++k)
      below[k] = {opens_a ? node_a.first + k : pair.a, opens_a ? pair.b : node_b.first + k};
    return 2;
  };
  const auto items = [&](NodePair pair) { return static_cast<int>(nodes_a[pair.a].count * nodes_b[pair.b].count); };
  const auto measure = [&](NodePair pair, int item) {
    const auto at = static_cast<std::uint32_t>(item);
    const std::uint32_t of_b = nodes_b[pair.b].count;
    Manifold m;
    triangles_touch(a, nodes_a[pair.a].first + at / of_b, b, nodes_b[pair.b].first + at % of_b, rounding_m, reach_m,
                    out.seen_m(ahead_m, rounding_m), m);
    return m;
  };
  Lanes::walk(open, items, measure, [&](const Manifold& m) { take_all<Lanes>(m, rounding_m, out); });
}

// Whether a vertex of one mesh is inside the other one; if so, its point, with the shortest way out. Sheets do not find
// it, because two triangles that are behind each other do not touch. is_a: the vertex is A's.
BROADSIDE_HD bool vertex_inside(const PlacedShape& of_vertex, std::uint32_t vertex, const PlacedShape& solid, bool is_a,
                                float rounding_m, Manifold& out) {
  const Vec3 x = of_vertex.center + turned(of_vertex.axes, of_vertex.shape->mesh.vertices[vertex]);
  const Vec3 local = turned_back(solid.axes, x - solid.center);
  if (!is_inside(solid.shape->mesh, local)) return false;
  const NearestOfMesh nearest = nearest_of_mesh(solid.shape->mesh, local, solid.shape->size_m);
  const float depth = sqrtf(nearest.squared_m2);
  // A vertex within rounding of the surface is found by the sheets.
  if (!(nearest.squared_m2 < 3.0e38F) || !(depth > 4.0F * rounding_m)) return false;
  const Vec3 way_out = turned(solid.axes, (1.0F / depth) * (nearest.point - local));
  out.normal = is_a ? way_out : -way_out;
  out.count = 1;
  const std::uint32_t corner = corner_name(vertex);
  const std::uint32_t face = face_name(nearest.triangle);
  out.points[0] = {x + (0.5F * depth) * way_out, -depth, is_a ? feature_key(corner, face) : feature_key(face, corner)};
  return true;
}

// Adds all vertices inside the other mesh, if one of them is deeper than every point that the sheets found.
template <typename Lanes>
BROADSIDE_HD_CALLED void add_vertices_inside(const PlacedShape& a, const PlacedShape& b, float rounding_m,
                                             Touches& out) {
  if (!a.shape->mesh.is_closed || !b.shape->mesh.is_closed) return;
  const TriangleNode& root_a = a.shape->mesh.nodes[0];
  const TriangleNode& root_b = b.shape->mesh.nodes[0];
  if (are_apart(a, 0.5F * (root_a.min + root_a.max), 0.5F * (root_a.max - root_a.min), b,
                0.5F * (root_b.min + root_b.max), 0.5F * (root_b.max - root_b.min), 0.0F))
    return;
  const auto of_a = static_cast<int>(a.shape->mesh.vertex_count);
  const int all = of_a + static_cast<int>(b.shape->mesh.vertex_count);
  const auto make = [&](int k, Manifold& made) {
    return k < of_a ? vertex_inside(a, static_cast<std::uint32_t>(k), b, true, rounding_m, made)
                    : vertex_inside(b, static_cast<std::uint32_t>(k - of_a), a, false, rounding_m, made);
  };
  float deepest = 0.0F;
  for (int k = 0; k < out.count; ++k) deepest = fminf(deepest, out.all[k].point.gap_m);
  typename Lanes::template Handful<Manifold> some;
  bool is_deeper = false;
  for (int pass = 0; pass < 2 && (pass == 0 || is_deeper); ++pass)
    for (int k = 0; k < all;) {
      k = some.fill(k, all, make);
      some.each_in_turn([](const Manifold&) { return true; },
                        [&](const Manifold& m) {
                          if (pass == 0)
                            is_deeper |= m.points[0].gap_m < deepest - 8.0F * rounding_m;
                          else
                            take_all<Lanes>(m, rounding_m, out);
                        });
    }
}

// Begins with overlaps, and goes on from near to far. Once there is no more room, triangles farther away than all kept
// points are skipped. The points do not depend on the order.
template <typename Lanes>
BROADSIDE_HD void meshes_touch(const PlacedShape& a, const PlacedShape& b, float rounding_m, float reach_m,
                               Touches& out) {
  constexpr float kFirst = 0x1p-5F;  // of the reach
  constexpr float kFarther = 4.0F;
  float ahead_m = fminf(8.0F * rounding_m, reach_m);
  mesh_against<Lanes>(a, b, rounding_m, reach_m, ahead_m, out);
  add_vertices_inside<Lanes>(a, b, rounding_m, out);
  while (out.seen_m(reach_m, rounding_m) > ahead_m) {
    ahead_m = fminf(reach_m, fmaxf(kFarther * ahead_m, kFirst * reach_m));
    mesh_against<Lanes>(a, b, rounding_m, reach_m, ahead_m, out);
  }
}

}  // namespace mesh_detail

// B is the mesh; A a convex shape or a mesh.
template <typename Lanes>
BROADSIDE_HD_CALLED int mesh_manifolds(const PlacedShape& a, const PlacedShape& b, float rounding_m, float reach_m,
                                       Manifold* out) {
  mesh_detail::Touches touches;
  if (a.shape->kind == ContactKind::kMesh)
    mesh_detail::meshes_touch<Lanes>(a, b, rounding_m, reach_m, touches);
  else
    mesh_detail::convex_against<Lanes>(a, b, rounding_m, reach_m, touches);
  return mesh_detail::patches_of<Lanes>(touches, rounding_m, reach_m, out);
}

// Corners of the mesh over a plane: one patch.
BROADSIDE_HD void mesh_plane_manifold(const PlacedShape& a, const PlacedShape& plane, float reach_m, Manifold& out) {
  const MeshView& mesh = a.shape->mesh;
  const Vec3 n = turned(plane.axes, plane.shape->normal);
  const Vec3 local = turned_back(a.axes, n);
  const float above = dot(n, a.center - plane.center);
  out.normal = n;
  keep_four_of(out, reach_m, kTurnOfStep, [&](const auto& consider) {
    std::uint32_t open[mesh_detail::kOpenNodes];
    int count = 0;
    open[count++] = 0;
    while (count > 0) {
      const TriangleNode& node = mesh.nodes[open[--count]];
      const Vec3 low{local.x > 0.0F ? node.min.x : node.max.x, local.y > 0.0F ? node.min.y : node.max.y,
                     local.z > 0.0F ? node.min.z : node.max.z};
      if (above + dot(local, low) > reach_m) continue;
      if (node.count == 0 && count + 2 <= mesh_detail::kOpenNodes) {
        open[count++] = node.first + 1;
        open[count++] = node.first;
      }
      for (std::uint32_t k = 3 * node.first; k < 3 * (node.first + node.count); ++k) {
        const std::uint32_t v = mesh.triangles[k];
        const float gap = above + dot(local, mesh.vertices[v]);
        const Vec3 p = a.center + turned(a.axes, mesh.vertices[v]);
        consider({p - (0.5F * gap) * n, gap, feature_key(corner_name(v), face_name(0))});
      }
    }
  });
}

}  // namespace broadside::core

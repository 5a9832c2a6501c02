// Boxes, segments and hulls seen as polytopes with corners, edges and faces, placed in the world and measured from the
// center of mass of body A. One interface, resolved at compile time.
#pragma once

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/lanes.hpp"

namespace broadside::core {

// Corner bits: 1, 2, 4 = upper in x, y, z. Face 2 k is the lower one of axis k, 2 k + 1 the upper one. Edges 4 k to
// 4 k + 3 run along axis k.
struct BoxPolytope {
  using Lanes = OneLane;
  static constexpr int kMostFaceCorners = 4;
  static constexpr bool kIsSheet = false;
  Vec3 center;
  TurnedAxes axes;
  Vec3 half;

  BROADSIDE_HD int corner_count() const { return 8; }
  BROADSIDE_HD int edge_count() const { return 12; }
  BROADSIDE_HD int face_count() const { return 6; }

  BROADSIDE_HD Vec3 corner(int k) const {
    const Vec3 local{(k & 1) != 0 ? half.x : -half.x, (k & 2) != 0 ? half.y : -half.y, (k & 4) != 0 ? half.z : -half.z};
    return center + turned(axes, local);
  }
  BROADSIDE_HD void edge(int k, int& from, int& to) const {
    const int axis = k / 4;
    const int u = axis == 0 ? 1 : 0;
    const int w = axis == 2 ? 1 : 2;
    from = ((k & 1) << u) | (((k >> 1) & 1) << w);
    to = from | (1 << axis);
  }
  BROADSIDE_HD void edge_faces(int k, int& left, int& right) const {
    const int axis = k / 4;
    left = 2 * (axis == 0 ? 1 : 0) + (k & 1);
    right = 2 * (axis == 2 ? 1 : 2) + ((k >> 1) & 1);
  }
  BROADSIDE_HD Vec3 face_normal(int k) const { return (k & 1) != 0 ? axes[k / 2] : -axes[k / 2]; }
  // The height of a face's plane along its normal.
  BROADSIDE_HD float face_height(int k) const { return dot(face_normal(k), center) + half[k / 2]; }
  BROADSIDE_HD Vec3 local_point(Vec3 x) const { return x; }
  BROADSIDE_HD float height_over(int k, Vec3 x) const { return dot(face_normal(k), x) - face_height(k); }
  // Heights of one body's corners along a direction that local() has prepared, to be compared with each other.
  BROADSIDE_HD Vec3 local(Vec3 direction) const { return direction; }
  BROADSIDE_HD float height(int k, Vec3 direction) const { return dot(direction, corner(k)); }
  BROADSIDE_HD int face_corner_count(int) const { return 4; }
  // Anticlockwise seen from outside.
  BROADSIDE_HD int face_corner(int face, int k) const {
    const int axis = face / 2;
    const int u = axis == 2 ? 0 : axis + 1;
    const int w = u == 2 ? 0 : u + 1;
    const bool is_upper = (face & 1) != 0;
    // Around: 00, 10, 11, 01 in (u, w); the lower face the other way.
    const int around = is_upper ? k : 3 - k;
    const int at_u = around == 1 || around == 2 ? 1 : 0;
    const int at_w = around >= 2 ? 1 : 0;
    return (is_upper ? 1 << axis : 0) | (at_u << u) | (at_w << w);
  }
  // The least of dot(direction, p) over the body.
  BROADSIDE_HD float least(Vec3 direction) const {
    const Vec3 d = turned_back(axes, direction);
    return dot(direction, center) - (fabsf(d.x) * half.x + fabsf(d.y) * half.y + fabsf(d.z) * half.z);
  }
  // The same, given which corner is lowest.
  BROADSIDE_HD float least_at(int, Vec3 direction) const { return least(direction); }
  BROADSIDE_HD int support_face(Vec3 direction) const {
    const Vec3 d = turned_back(axes, direction);
    const Vec3 size{fabsf(d.x), fabsf(d.y), fabsf(d.z)};
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    return 2 * axis + (d[axis] > 0.0F ? 1 : 0);
  }
};

BROADSIDE_HD BoxPolytope box_polytope(const PlacedShape& p) {
  return {p.center, p.axes, p.shape->half};
}

// The middle line of a capsule: two corners, one edge, no face.
struct SegmentPolytope {
  using Lanes = OneLane;
  static constexpr int kMostFaceCorners = 2;
  static constexpr bool kIsSheet = false;
  Vec3 center;
  Vec3 half;  // from the center to corner 1

  BROADSIDE_HD int corner_count() const { return 2; }
  BROADSIDE_HD int edge_count() const { return 1; }
  BROADSIDE_HD int face_count() const { return 0; }
  BROADSIDE_HD Vec3 corner(int k) const { return k == 0 ? center - half : center + half; }
  BROADSIDE_HD void edge(int, int& from, int& to) const {
    from = 0;
    to = 1;
  }
  BROADSIDE_HD void edge_faces(int, int& left, int& right) const { left = right = 0; }
  BROADSIDE_HD Vec3 face_normal(int) const { return {}; }
  BROADSIDE_HD float face_height(int) const { return 0.0F; }
  BROADSIDE_HD Vec3 local_point(Vec3 x) const { return x; }
  BROADSIDE_HD float height_over(int k, Vec3 x) const { return dot(face_normal(k), x) - face_height(k); }
  BROADSIDE_HD Vec3 local(Vec3 direction) const { return direction; }
  BROADSIDE_HD float height(int k, Vec3 direction) const { return dot(direction, corner(k)); }
  BROADSIDE_HD int face_corner_count(int) const { return 2; }
  BROADSIDE_HD int face_corner(int, int k) const { return k; }
  BROADSIDE_HD float least(Vec3 direction) const { return dot(direction, center) - fabsf(dot(direction, half)); }
  BROADSIDE_HD float least_at(int, Vec3 direction) const { return least(direction); }
  BROADSIDE_HD int support_face(Vec3) const { return 0; }
};

BROADSIDE_HD SegmentPolytope segment_polytope(const PlacedShape& p) {
  return {p.center, p.shape->half_length_m * p.axes[p.shape->axis]};
}

// A triangle of a mesh: a sheet with a front (face 0) and a back.
struct TrianglePolytope {
  using Lanes = OneLane;
  static constexpr int kMostFaceCorners = 3;
  static constexpr bool kIsSheet = true;
  Vec3 center;
  Vec3 corners[3];
  Vec3 normal;  // of the front

  BROADSIDE_HD int corner_count() const { return 3; }
  BROADSIDE_HD int edge_count() const { return 3; }
  BROADSIDE_HD int face_count() const { return 2; }
  BROADSIDE_HD Vec3 corner(int k) const { return corners[k]; }
  BROADSIDE_HD void edge(int k, int& from, int& to) const {
    from = k;
    to = k == 2 ? 0 : k + 1;
  }
  BROADSIDE_HD void edge_faces(int, int& left, int& right) const {
    left = 0;
    right = 1;
  }
  BROADSIDE_HD Vec3 face_normal(int k) const { return k == 0 ? normal : -normal; }
  BROADSIDE_HD float face_height(int k) const { return dot(face_normal(k), corners[0]); }
  BROADSIDE_HD Vec3 local_point(Vec3 x) const { return x; }
  BROADSIDE_HD float height_over(int k, Vec3 x) const { return dot(face_normal(k), x) - face_height(k); }
  BROADSIDE_HD Vec3 local(Vec3 direction) const { return direction; }
  BROADSIDE_HD float height(int k, Vec3 direction) const { return dot(direction, corners[k]); }
  BROADSIDE_HD int face_corner_count(int) const { return 3; }
  BROADSIDE_HD int face_corner(int face, int k) const { return face == 0 ? k : 2 - k; }
  BROADSIDE_HD float least(Vec3 direction) const {
    return fminf(fminf(dot(direction, corners[0]), dot(direction, corners[1])), dot(direction, corners[2]));
  }
  BROADSIDE_HD float least_at(int, Vec3 direction) const { return least(direction); }
  BROADSIDE_HD int support_face(Vec3 direction) const { return dot(normal, direction) >= 0.0F ? 0 : 1; }
};

// LanesOfHull: the lanes that share loops over its corners, edges and faces (lanes.hpp).
template <typename LanesOfHull>
struct HullPolytopeOf {
  using Lanes = LanesOfHull;
  static constexpr int kMostFaceCorners = kFaceCorners;
  static constexpr bool kIsSheet = false;
  Vec3 center;
  TurnedAxes axes;
  HullView hull;
  const NearestOfHulls* known_gap = nullptr;  // as in PlacedShape

  BROADSIDE_HD int corner_count() const { return static_cast<int>(hull.vertex_count); }
  BROADSIDE_HD int edge_count() const { return static_cast<int>(hull.edge_count); }
  BROADSIDE_HD int face_count() const { return static_cast<int>(hull.face_count); }
  BROADSIDE_HD Vec3 corner(int k) const { return center + turned(axes, hull.vertices[k]); }
  BROADSIDE_HD void edge(int k, int& from, int& to) const {
    from = static_cast<int>(hull.edges[k].from);
    to = static_cast<int>(hull.edges[k].to);
  }
  BROADSIDE_HD void edge_faces(int k, int& left, int& right) const {
    left = static_cast<int>(hull.edges[k].left);
    right = static_cast<int>(hull.edges[k].right);
  }
  BROADSIDE_HD Vec3 face_normal(int k) const { return turned(axes, hull.faces[k].normal); }
  BROADSIDE_HD float face_height(int k) const { return dot(face_normal(k), center) + hull.faces[k].offset_m; }
  // Heights over faces of points that local_point() has prepared: as exact as in world axes, and cheaper where points
  // are few.
  BROADSIDE_HD Vec3 local_point(Vec3 x) const { return turned_back(axes, x - center); }
  BROADSIDE_HD float height_over(int k, Vec3 x) const { return dot(hull.faces[k].normal, x) - hull.faces[k].offset_m; }
  // In body axes, from the hull's own center. Only differences of heights of one hull have a meaning.
  BROADSIDE_HD Vec3 local(Vec3 direction) const { return turned_back(axes, direction); }
  BROADSIDE_HD float height(int k, Vec3 direction) const { return dot(direction, hull.vertices[k]); }
  BROADSIDE_HD int face_corner_count(int k) const { return static_cast<int>(hull.faces[k].corner_count); }
  BROADSIDE_HD int face_corner(int face, int k) const {
    return static_cast<int>(hull.corners[hull.faces[face].first_corner + static_cast<std::uint32_t>(k)]);
  }
  BROADSIDE_HD float least(Vec3 direction) const {
    const Vec3 d = turned_back(axes, direction);
    return dot(direction, center) +
           Lanes::first_least(corner_count(), [&](int k) { return dot(d, hull.vertices[k]); }).value;
  }
  BROADSIDE_HD float least_at(int k, Vec3 direction) const { return dot(direction, corner(k)); }
  BROADSIDE_HD int support_face(Vec3 direction) const {
    const Vec3 d = turned_back(axes, direction);
    return Lanes::first_least(face_count(), [&](int k) { return -dot(hull.faces[k].normal, d); }).item;
  }
};
using HullPolytope = HullPolytopeOf<OneLane>;

template <typename Lanes = OneLane>
BROADSIDE_HD HullPolytopeOf<Lanes> hull_polytope(const PlacedShape& p) {
  return {p.center, p.axes, p.shape->hull, p.known_gap};
}

}  // namespace broadside::core

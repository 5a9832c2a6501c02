// A body's shape as contacts see it: a plain view without ownership, for host and device. RIGID 8.4.
//
// Boxes, spheres, capsules and cylinders are the true closed-form surfaces; hulls and meshes point into tables of their
// own (core/scene/contact_shapes.hpp builds all of them from a scene).
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/quat.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/cross.hpp"

namespace broadside::core {

// Of two shapes, the one of the lower kind is A, so that each family of pairs is written once.
enum class ContactKind : std::uint32_t { kSphere, kCapsule, kBox, kCylinder, kHull, kMesh, kHalfSpace };

// A face of a hull has at most this many corners; a larger face is stored as several faces in one plane.
inline constexpr int kFaceCorners = 16;

struct alignas(16) HullFace {
  Vec3 normal;            // unit, outward, body axes
  float offset_m = 0.0F;  // of the plane, from the mesh's origin along the normal
  std::uint32_t first_corner = 0;
  std::uint32_t corner_count = 0;  // anticlockwise seen from outside
};

struct HullEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t left = 0;  // the two faces
  std::uint32_t right = 0;
};

// From a corner of a hull along an edge to a neighbor.
struct alignas(16) HullWay {
  Vec3 along;
  std::uint32_t to = 0;
};

struct HullView {
  const Vec3* vertices = nullptr;  // mesh coordinates, m; only those on the hull
  const HullFace* faces = nullptr;
  const std::uint32_t* corners = nullptr;  // of faces: indices of vertices
  const HullEdge* edges = nullptr;
  // The ways from each corner, corner by corner, and where to find them (hull_climb.hpp). Both are null for hulls that
  // are built during contact detection.
  const HullWay* ways = nullptr;
  const std::uint32_t* guide = nullptr;
  // Indexed like `corners`: the face beyond the side from this corner to the next one, or the face itself where there
  // is none.
  const std::uint32_t* beyond = nullptr;
  std::uint32_t vertex_count = 0;
  std::uint32_t face_count = 0;
  std::uint32_t edge_count = 0;
};

// A node of the tree over a mesh's triangles: its children are `first` and `first + 1`, or its triangles are `first` to
// `first + count - 1`.
struct TriangleNode {
  Vec3 min;
  std::uint32_t first = 0;
  Vec3 max;
  std::uint32_t count = 0;  // of triangles; 0 = an inner node
  // The surfaces of the node's triangles look only in directions of a cone around the unit direction `looking`.
  // least_looking is the cosine of the cone's half angle, or -1 where that angle is a right angle or more. Johnson and
  // Cohen, Spatialized Normal Cone Hierarchies (2001).
  Vec3 looking;
  float least_looking = -1.0F;
};

struct MeshView {
  const Vec3* vertices = nullptr;            // mesh coordinates, m
  const std::uint32_t* triangles = nullptr;  // three corners each, in the order of the tree
  const Vec3* normals = nullptr;             // of triangles: unit, outward
  // The least cosine between a triangle's normal and those beyond its convex edges; 1 where it has none.
  const float* least_facing = nullptr;
  const TriangleNode* nodes = nullptr;
  std::uint32_t vertex_count = 0;
  std::uint32_t triangle_count = 0;
  std::uint32_t node_count = 0;
  bool is_closed = false;  // it has an inside: it is neither open nor crosses itself
};

struct ContactShape {
  ContactKind kind = ContactKind::kSphere;
  int axis = 0;                // of a capsule or cylinder
  Vec3 center;                 // of the shape (the mesh's origin), from the body's center of mass, body axes, m
  Vec3 half;                   // of a box, m
  float radius_m = 0.0F;       // of a sphere, capsule or cylinder
  float half_length_m = 0.0F;  // of a capsule's segment, or of a cylinder
  float size_m = 0.0F;         // no point of the surface is farther from `center`; 0 for a half-space
  Vec3 normal;                 // of a half-space: unit, out of the solid, body axes; its plane goes through `center`
  HullView hull;
  MeshView mesh;
};

// Where the body's center of mass is, and how the body is turned.
struct ContactPose {
  Vec3 x;
  Quat q;
};

// Within a step.
struct ContactPath {
  ContactPose start;
  ContactPose end;  // if it touches nothing
};

struct NearestOfHulls;

// A shape in axes of the world, measured from the center of mass of body A. Positions are subtracted before anything
// else, so bodies a kilometer from the origin have the contacts of bodies at the origin.
struct PlacedShape {
  const ContactShape* shape = nullptr;
  Vec3 center;
  TurnedAxes axes;
  const NearestOfHulls* known_gap =
      nullptr;  // to the other shape, where both are hulls and it is known: known_gaps.hpp
};

BROADSIDE_HD PlacedShape placed_shape(const ContactShape& shape, const ContactPose& pose, Vec3 origin) {
  const TurnedAxes axes = turned_axes(pose.q);
  return {&shape, (pose.x - origin) + turned(axes, shape.center), axes};
}

// How far rounding can move a gap: the unit roundoff, times the lengths from which the gap is computed, times the
// number of roundings in a row from coordinates to gap. A corner takes three products and sums in each of two turns and
// two shifts; a direction that is a normalized cross product takes ten; a plane's height five; a quaternion has length
// 1 to within two roundings.
inline constexpr float kContactRoundings = 32.0F;

BROADSIDE_HD float contact_rounding_m(const PlacedShape& a, const PlacedShape& b) {
  const Vec3 d = b.center - a.center;
  const float lengths = fabsf(d.x) + fabsf(d.y) + fabsf(d.z) + a.shape->size_m + b.shape->size_m;
  return kContactRoundings * 0x1p-24F * lengths;
}

}  // namespace broadside::core

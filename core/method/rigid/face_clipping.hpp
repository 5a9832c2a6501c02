// What two faces have in common, seen along the normal of the contact: the points of a manifold of polytopes.
//
// The incident face of one body is clipped by the sides of the reference face of the other one (Sutherland and Hodgman,
// Reentrant Polygon Clipping, 1974). Corners of the result are corners of either face or crossings of their edges.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/kept_loop.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/room.hpp"

namespace broadside::core {

// A face that is steeper than 60 degrees against the normal is not taken as the reference: heights over it would be off
// by more than twice the rounding of the points.
inline constexpr float kSteepestReference = 0.5F;

struct ClippedCorner {
  Vec3 point;
  std::uint32_t name = 0;     // of the corner
  std::uint32_t leaving = 0;  // of the edge from this corner to the next one
};

// A convex polygon, or a segment of two corners. Each cut by a side adds at most one corner.
template <int kRoom>
struct ClippedFace {
  int count = 0;
  Room<ClippedCorner, kRoom> corners;
};

template <typename Polytope, int kRoom>
BROADSIDE_HD void load_face(const Polytope& p, int face, ClippedFace<kRoom>& out) {
  out.count = p.face_corner_count(face);
  BROADSIDE_KEPT_LOOP
  for (int k = 0; k < out.count; ++k) {
    const int corner = p.face_corner(face, k);
    const int next = p.face_corner(face, k + 1 == out.count ? 0 : k + 1);
    out.corners[k] = {p.corner(corner), corner_name(static_cast<std::uint32_t>(corner)),
                      edge_name(static_cast<std::uint32_t>(corner), static_cast<std::uint32_t>(next))};
  }
}

// Keeps the part behind the plane through `start` with the outward direction `out` (of any length), or at most
// rounding_m in front: corners that lie on the side stay corners. `side` is the name of that side. kept: working space,
// whatever it holds; making a new one for each side would cost more than the clipping.
template <int kRoom>
BROADSIDE_HD void clip(ClippedFace<kRoom>& face, ClippedFace<kRoom>& kept, Vec3 start, Vec3 out, std::uint32_t side,
                       float rounding_m) {
  const float slack = rounding_m * length(out);
  kept.count = 0;
  const bool is_segment = face.count == 2;
  BROADSIDE_KEPT_LOOP
  for (int k = 0; k < face.count; ++k) {
    const ClippedCorner& here = face.corners[k];
    const float height = dot(out, here.point - start);
    if (height <= slack && kept.count < kRoom) kept.corners[kept.count++] = here;
    if (face.count == 1 || (is_segment && k == 1)) continue;
    const ClippedCorner& next = face.corners[k + 1 == face.count ? 0 : k + 1];
    const float next_height = dot(out, next.point - start);
    if ((height <= slack) == (next_height <= slack)) continue;
    const bool leaves = height <= slack;
    // Cut from the corner that is kept, so that equal edges are cut alike in both directions.
    const float inside = leaves ? height : next_height;
    const float outside = leaves ? next_height : height;
    if (!(inside < 0.0F)) {  // the corner that is kept lies on the side
      if (leaves) kept.corners[kept.count - 1].leaving = side;
      continue;
    }
    const Vec3 from = leaves ? here.point : next.point;
    const Vec3 to = leaves ? next.point : here.point;
    if (kept.count < kRoom)
      kept.corners[kept.count++] = {from + (inside / (inside - outside)) * (to - from), feature_key(here.leaving, side),
                                    leaves ? side : here.leaving};
  }
  // Corner by corner: most of the room is empty.
  face.count = kept.count;
  BROADSIDE_KEPT_LOOP
  for (int k = 0; k < kept.count; ++k) face.corners[k] = kept.corners[k];
}

// The incident face, cut by the sides of the reference; each corner of the result is a point halfway between both
// surfaces. normal: unit, from B to A. reference_is_a: the reference is A's face. A count of 0 says that the faces have
// nothing in common, or that the reference is too steep.
template <int kRoom>
struct CommonArea {
  int count = 0;
  Room<ManifoldPoint, kRoom> points;
};

template <typename Reference, typename Incident, int kRoom>
BROADSIDE_HD_CALLED void common_area(const Reference& reference, int reference_face, const Incident& incident,
                                     int incident_face, Vec3 normal, bool reference_is_a, float rounding_m,
                                     CommonArea<kRoom>& out) {
  out.count = 0;
  const int sides = reference.face_corner_count(reference_face);
  const Vec3 plane = reference.face_normal(reference_face);
  // Out of the reference's body.
  const Vec3 outward = reference_is_a ? -normal : normal;
  const float facing = dot(plane, outward);
  if (sides < 3 || !(facing >= kSteepestReference)) return;
  ClippedFace<kRoom> face;
  ClippedFace<kRoom> kept;
  load_face(incident, incident_face, face);
  Vec3 start = reference.corner(reference.face_corner(reference_face, 0));
  const Vec3 on_plane = start;
  BROADSIDE_KEPT_LOOP
  for (int k = 0; k < sides && face.count > 0; ++k) {
    const int corner = reference.face_corner(reference_face, k);
    const int next = reference.face_corner(reference_face, k + 1 == sides ? 0 : k + 1);
    const Vec3 end = reference.corner(next);
    clip(face, kept, start, cross(end - start, outward),
         edge_name(static_cast<std::uint32_t>(corner), static_cast<std::uint32_t>(next)), rounding_m);
    start = end;
  }
  const std::uint32_t plane_name = face_name(static_cast<std::uint32_t>(reference_face));
  BROADSIDE_KEPT_LOOP
  for (int k = 0; k < face.count; ++k) {
    const Vec3 p = face.corners[k].point;
    const float gap = dot(plane, p - on_plane) / facing;
    const std::uint32_t name = face.corners[k].name;
    const std::uint32_t key = reference_is_a ? feature_key(plane_name, name) : feature_key(name, plane_name);
    out.points[k] = {p - (0.5F * gap) * outward, gap, key};
  }
  out.count = face.count;
}

}  // namespace broadside::core

// Where two round polytopes would touch next if they tilted a little: more points for their manifold.
//
// Faces of a finely cut hull are small, so the common area of two of them is a spot. Bodies that roll over each other
// leave this spot within a step, and meet half their size away, where no point was. Before, bunnies in a heap ended 8
// cm deep in each other. Bullet tilts a body and detects again (btConvexConvexAlgorithm, its perturbed manifold). Here
// the corners that are lowest along tilted directions are looked up, with their gaps in the present, untilted poses.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/corner_layer.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/face_clipping.hpp"
#include "core/method/rigid/hull_climb.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/polytopes.hpp"
#include "core/room.hpp"

namespace broadside::core {

// Tilts go in four directions across the normal, by two angles each, given as tangents of these angles; the larger
// angle is about half a radian.
inline constexpr int kTilts = 8;
inline constexpr float kLargestTilt = 0.5F;

namespace tilt_detail {

template <typename Polytope>
BROADSIDE_HD int lowest_of(const Polytope& p, Vec3 direction) {
  return lowest_corner(p, direction);
}
template <typename Lanes>
BROADSIDE_HD int lowest_of(const HullPolytopeOf<Lanes>& p, Vec3 direction) {
  const Vec3 local = p.local(direction);
  return static_cast<int>(climb_down(p.hull, local, climb_start(p.hull, local)));
}

// The face through which the line through x along `up` leaves the body on its way up; -1: the line misses the body. The
// search begins at face `from`, and goes on to the neighbor across a side beyond which the line is. The line meets each
// next plane lower than the one before, so no face comes twice. A line that is beside a face by no more than rounding_m
// counts as over it. Also -1 where x is higher than most_m over the body. One plane shows that: x is at least as high
// over the body as over the plane of any face that looks up.
template <typename Lanes>
BROADSIDE_HD_CALLED int face_below(const HullPolytopeOf<Lanes>& p, int from, Vec3 x, Vec3 up, float rounding_m,
                                   float most_m) {
  const HullView& hull = p.hull;
  const Vec3 local = turned_back(p.axes, x - p.center);
  const Vec3 local_up = turned_back(p.axes, up);
  auto at = static_cast<std::uint32_t>(from);
  for (std::uint32_t step = 0; step < hull.face_count; ++step) {
    const HullFace& face = hull.faces[at];
    std::uint32_t next = at;
    bool is_over = true;
    const float facing = dot(face.normal, local_up);
    const float outside = dot(face.normal, local) - face.offset_m;
    if (facing > 0.0F && outside - rounding_m > (most_m + 4.0F * rounding_m) * facing) return -1;
    Vec3 start = hull.vertices[hull.corners[face.first_corner]];
    for (std::uint32_t k = 0; k < face.corner_count && is_over; ++k) {
      const std::uint32_t of_next = face.first_corner + (k + 1 == face.corner_count ? 0 : k + 1);
      const Vec3 end = hull.vertices[hull.corners[of_next]];
      const Vec3 side = cross(end - start, local_up);
      const float beyond = dot(side, local - start);
      start = end;
      if (!(beyond > 0.0F) || !(beyond > rounding_m * length(side))) continue;
      is_over = false;
      next = hull.beyond[face.first_corner + k];
    }
    if (is_over) return static_cast<int>(at);
    if (next == at || !(dot(hull.faces[next].normal, local_up) > 0.0F)) return -1;
    at = next;
  }
  return -1;
}
// The same for polytopes with few faces: all faces are tried.
template <typename Polytope>
BROADSIDE_HD int face_below(const Polytope& p, int, Vec3 x, Vec3 up, float rounding_m, float) {
  int entered = -1;
  float entry = -3.402823e38F;
  float exit = 3.402823e38F;
  for (int k = 0; k < p.face_count(); ++k) {
    const Vec3 n = p.face_normal(k);
    const float outside = dot(n, x) - p.face_height(k);
    const float along = dot(n, up);
    if (along == 0.0F && outside > rounding_m) return -1;
    if (along < 0.0F) exit = fminf(exit, outside / along);
    if (!(along > 0.0F) || !(outside > entry * along)) continue;
    entry = outside / along;
    entered = k;
  }
  return entry <= exit ? entered : -1;
}

}  // namespace tilt_detail

// The height of x, a point of the other body, above this one along the unit direction up; negative inside. False where
// the line through x misses the body, or meets a face too steep for the height to be a gap, and perhaps where the
// height is more than most_m. top: a face that looks up.
template <typename Polytope>
BROADSIDE_HD bool height_above(const Polytope& body, int top, Vec3 x, Vec3 up, float rounding_m, float most_m,
                               float& height_m) {
  const int face = tilt_detail::face_below(body, top, x, up, rounding_m, most_m);
  if (face < 0) return false;
  const Vec3 n = body.face_normal(face);
  const float facing = dot(n, up);
  height_m = (dot(n, x) - body.face_height(face)) / facing;
  return facing >= kSteepestReference;
}

struct TiltedContacts {
  int count = 0;
  Room<ManifoldPoint, 2 * kTilts> points;
};

// normal: unit, from B to A. top_of_a and top_of_b: faces that look at the other body. Points with a gap of more than
// most_m may be left out.
template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD_CALLED void tilted_contacts(const PolytopeA& a, const PolytopeB& b, Vec3 normal, Vec3 across, int top_of_a,
                                         int top_of_b, float rounding_m, float most_m, TiltedContacts& out) {
  out.count = 0;
  const Vec3 other = cross(normal, across);
  // The corner of a body that is lowest along a direction, and its height above the other body.
  const auto make = [&](const auto& body, const auto& below, int top, Vec3 up, Vec3 tilted, bool is_a,
                        ManifoldPoint& made) {
    const int corner = tilt_detail::lowest_of(body, tilted);
    const auto name = corner_name(static_cast<std::uint32_t>(corner));
    const Vec3 x = body.corner(corner);
    float gap = 0.0F;
    if (!height_above(below, top, x, up, rounding_m, most_m, gap)) return false;
    made = {x - (0.5F * gap) * up, gap, is_a ? feature_key(name, face_name(0)) : feature_key(face_name(0), name)};
    return true;
  };
  // For each tilt first a corner of A, then one of B.
  typename LanesOf<PolytopeA, PolytopeB>::template Handful<ManifoldPoint> found;
  (void)found.fill(0, 2 * kTilts, [&](int k, ManifoldPoint& made) {
    const int tilt = k / 2;
    const float size = tilt < kTilts / 2 ? kLargestTilt : 0.25F * kLargestTilt;
    const Vec3 way = ((tilt & 1) != 0 ? -size : size) * ((tilt & 2) != 0 ? other : across);
    return (k & 1) == 0 ? make(a, b, top_of_b, normal, normal + way, true, made)
                        : make(b, a, top_of_a, -normal, way - normal, false, made);
  });
  found.each_in_turn([](const ManifoldPoint&) { return true; },
                     [&](const ManifoldPoint& p) {
                       for (int k = 0; k < out.count; ++k)
                         if (out.points[k].feature == p.feature) return;
                       out.points[out.count++] = p;
                     });
}

}  // namespace broadside::core

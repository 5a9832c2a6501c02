// The manifold of two hulls. Where they are clearly apart, the search for their nearest points has already found the
// direction in which they are farthest apart, so only the two faces that look along it are tried.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/hull_gap.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/near_bound.hpp"
#include "core/method/rigid/overlap_axis.hpp"
#include "core/method/rigid/polytope_axes.hpp"
#include "core/method/rigid/polytope_manifold.hpp"
#include "core/method/rigid/polytopes.hpp"
#include "core/method/rigid/separating_axis.hpp"

namespace broadside::core {

namespace hull_detail {

BROADSIDE_HD bool are_clearly_apart(const NearestOfHulls& near, float rounding_m) {
  return near.corners.count > 0 && near.gap.least_m > kClearlyApartRoundings * rounding_m &&
         near.gap.most_m - near.gap.least_m <= rounding_m;
}

template <typename Hull>
BROADSIDE_HD Vec3 sum_of(const Hull& hull, const std::uint32_t* corners, const NearestCorners& near) {
  Vec3 x;
  for (int k = 0; k < near.count; ++k) x = x + near.weights[k] * hull.corner(static_cast<int>(corners[k]));
  return x;
}

// The name of the corner, edge or face that has these corners, in whatever order they come.
BROADSIDE_HD std::uint32_t name_of(const std::uint32_t* corners, int count) {
  const std::uint32_t p = corners[0];
  std::uint32_t q = p;
  for (int k = 1; k < count; ++k) {
    const std::uint32_t next = corners[k];
    if (next == p || next == q) continue;
    if (q != p) return face_name(p + q + next);
    q = next;
  }
  return q == p ? corner_name(p) : edge_name(p, q);
}

template <typename Hull>
BROADSIDE_HD NearestPoints points_of(const Hull& a, const Hull& b, const NearestCorners& near) {
  return {sum_of(a, near.of_a, near), sum_of(b, near.of_b, near),
          feature_key(name_of(near.of_a, near.count), name_of(near.of_b, near.count))};
}

// How far the other body is in front of a face.
template <typename Hull>
BROADSIDE_HD_CALLED float gap_over_face(const Hull& reference, const Hull& other, int face) {
  const Vec3 out = reference.face_normal(face);
  const auto lowest = static_cast<int>(lowest_along(other.hull, other.local(out)));
  return other.least_at(lowest, out) - reference.face_height(face);
}

// The axis of hulls that are apart by least_m along n, and hardly farther along any other direction. Like
// separating_axis it prefers a face whose gap is as wide to within rounding.
template <typename Hull>
BROADSIDE_HD SeparatingAxis axis_near(const Hull& a, const Hull& b, Vec3 n, float least_m, float rounding_m) {
  const int face_a = a.support_face(-n);
  const int face_b = b.support_face(n);
  const float over_a = gap_over_face(a, b, face_a);
  const float over_b = gap_over_face(b, a, face_b);
  SeparatingAxis axis{over_a, -a.face_normal(face_a), AxisKind::kFaceOfA, face_a, face_b};
  if (over_b > over_a + rounding_m) axis = {over_b, b.face_normal(face_b), AxisKind::kFaceOfB, face_a, face_b};
  if (least_m > axis.gap_m + rounding_m) axis = {least_m, n, AxisKind::kPoints, face_a, face_b};
  axis.has_faces = true;
  axis.face_of_a = face_a;
  axis.face_of_b = face_b;
  return axis;
}

}  // namespace hull_detail

// out.count is kLeft if the lane leaves the pair to lanes that share its loops (OneLaneOfHulls).
template <typename Lanes>
BROADSIDE_HD void hull_manifold(HullPolytopeOf<Lanes> a, const HullPolytopeOf<Lanes>& b, float rounding_m,
                                float reach_m, Manifold& out) {
  SeparatingAxis axis;
  NearestOfHulls near;
  NearestPoints points;
  bool is_near = false;
  if (has_many_edges(a, b)) {
    near = nearest_of(a, b, rounding_m);
    a.known_gap = &near;
    is_near = hull_detail::are_clearly_apart(near, rounding_m);
  }
  if (is_near) {
    axis = hull_detail::axis_near(a, b, near.gap.normal, near.gap.least_m, rounding_m);
    points = hull_detail::points_of(a, b, near.corners);
  } else if (a.known_gap == nullptr || !overlap_axis(a, b, *a.known_gap, rounding_m, axis)) {
    if constexpr (Lanes::kLeavesHardPairs) {
      out.count = kLeft;
      return;
    }
    axis = separating_axis(a, b, rounding_m, reach_m);
  }
  polytope_manifold(a, b, axis, 0.0F, 0.0F, rounding_m, reach_m, out, is_near ? &points : nullptr);
}

}  // namespace broadside::core

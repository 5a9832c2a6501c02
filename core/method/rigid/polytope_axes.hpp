// The separating axis of two polytopes of any kind: across the faces of either, and across an edge of each.
//
// Only edges whose normals meet on the sphere of directions make a face of the difference of both bodies (Gregorius,
// The Separating Axis Test between Convex Polyhedra, 2013); the others are skipped. Unlike there, the gap of an axis
// that would be taken is measured again with all corners along it, so each is a true lower bound of the distance even
// where edges are nearly parallel and their cross product is mostly rounding.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/nearest_features.hpp"
#include "core/method/rigid/separating_axis.hpp"

namespace broadside::core {

namespace axes_detail {

// Edges of the two, each between two faces, as arcs between normals on the sphere of directions: do they cross?
// b_left and b_right are negated normals.
BROADSIDE_HD bool arcs_cross(Vec3 a_left, Vec3 a_right, Vec3 b_left, Vec3 b_right) {
  const Vec3 across_a = cross(a_right, a_left);
  const Vec3 across_b = cross(b_right, b_left);
  const float cba = dot(b_left, across_a);
  const float dba = dot(b_right, across_a);
  const float adc = dot(a_left, across_b);
  const float bdc = dot(a_right, across_b);
  return cba * dba <= 0.0F && adc * bdc <= 0.0F && cba * bdc >= 0.0F;
}

// A direction across an edge between two faces: is it between their normals?
BROADSIDE_HD bool lies_between(Vec3 n, Vec3 left, Vec3 right) {
  const Vec3 middle = cross(left, right);
  return dot(n, left + right) > 0.0F && dot(middle, cross(left, n)) >= 0.0F && dot(middle, cross(n, right)) >= 0.0F;
}

template <typename Reference, typename Other>
BROADSIDE_HD SeparatingAxis axis_of_faces(const Reference& reference, const Other& other, bool reference_is_a) {
  SeparatingAxis best;
  for (int k = 0; k < reference.face_count(); ++k) {
    const Vec3 out = reference.face_normal(k);
    const float gap = least_along(other, out) - dot(out, reference.corner(reference.face_corner(k, 0)));
    if (!(gap > best.gap_m)) continue;
    if (reference_is_a)
      best = {gap, -out, AxisKind::kFaceOfA, k, 0};
    else
      best = {gap, out, AxisKind::kFaceOfB, 0, k};
  }
  return best;
}

}  // namespace axes_detail

// Of two segments alone, which have no faces, there may be none.
template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD SeparatingAxis separating_axis(const PolytopeA& a, const PolytopeB& b, float rounding_m, float reach_m) {
  SeparatingAxis best = axes_detail::axis_of_faces(a, b, true);
  if (best.gap_m > reach_m) return best;
  const SeparatingAxis of_b = axes_detail::axis_of_faces(b, a, false);
  if (best.kind == AxisKind::kNone || of_b.gap_m > best.gap_m + rounding_m) best = of_b;
  if (best.gap_m > reach_m) return best;
  SeparatingAxis edges;
  for (int i = 0; i < a.edge_count(); ++i) {
    int a0 = 0;
    int a1 = 0;
    a.edge(i, a0, a1);
    const Vec3 p = a.corner(a0);
    const Vec3 u = a.corner(a1) - p;
    Vec3 a_left;
    Vec3 a_right;
    if (a.face_count() > 0) {
      int left = 0;
      int right = 0;
      a.edge_faces(i, left, right);
      a_left = a.face_normal(left);
      a_right = a.face_normal(right);
    }
    for (int j = 0; j < b.edge_count(); ++j) {
      int b0 = 0;
      int b1 = 0;
      b.edge(j, b0, b1);
      Vec3 b_left;
      Vec3 b_right;
      if (b.face_count() > 0) {
        int left = 0;
        int right = 0;
        b.edge_faces(j, left, right);
        b_left = b.face_normal(left);
        b_right = b.face_normal(right);
        if (a.face_count() > 0 && !axes_detail::arcs_cross(a_left, a_right, -b_left, -b_right)) continue;
      }
      const Vec3 q = b.corner(b0);
      const Vec3 v = b.corner(b1) - q;
      const Vec3 across = cross(u, v);
      const float squared = dot(across, across);
      if (!(squared > kParallelSine * kParallelSine * (dot(u, u) * dot(v, v)))) continue;
      Vec3 n = across_edges(u, v, p - q);
      if (a.face_count() > 0) {
        if (dot(n, a_left + a_right) > 0.0F) n = -n;
      } else if (b.face_count() > 0) {
        if (dot(n, b_left + b_right) < 0.0F) n = -n;
      }
      if (b.face_count() > 0 && a.face_count() == 0 && !axes_detail::lies_between(n, b_left, b_right)) continue;
      if (a.face_count() > 0 && b.face_count() == 0 && !axes_detail::lies_between(-n, a_left, a_right)) continue;
      if (!(dot(n, p - q) > edges.gap_m)) continue;
      const float gap = gap_along(a, b, n);
      if (gap > edges.gap_m) edges = {gap, n, AxisKind::kEdges, i, j};
    }
  }
  return edges.gap_m > best.gap_m + rounding_m ? edges : best;
}

}  // namespace broadside::core

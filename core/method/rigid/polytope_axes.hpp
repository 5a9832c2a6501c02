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

// A face that is in front of a corner of the other body by no more than the best gap so far is passed over; that
// corner is the last one that stood out.
template <typename Reference, typename Other>
BROADSIDE_HD SeparatingAxis axis_of_faces(const Reference& reference, const Other& other, bool reference_is_a) {
  SeparatingAxis best;
  Vec3 standing_out = other.corner(0);
  for (int k = 0; k < reference.face_count(); ++k) {
    const Vec3 out = reference.face_normal(k);
    const float height = reference.face_height(k);
    if (!(dot(out, standing_out) - height > best.gap_m)) continue;
    const float gap = other.least(out) - height;
    if (gap > best.gap_m) {
      if (reference_is_a)
        best = {gap, -out, AxisKind::kFaceOfA, k, 0};
      else
        best = {gap, out, AxisKind::kFaceOfB, 0, k};
    }
    standing_out = other.corner(lowest_corner(other, out));
  }
  return best;
}

// Up to so many pairs of edges (two boxes have 144) all are tried without a look at where they are.
inline constexpr int kFewEdgePairs = 256;

// Edges of large hulls are compared while there are at most so many pairs of them (0.05 s on a slow core). Beyond, and
// that is deep inside each other, those farthest inside are left out: a depth is then that across a face.
inline constexpr int kMostEdgePairs = 1 << 16;
// After these a layer is as thick as rounding.
inline constexpr int kMostHalvings = 24;

template <typename Polytope>
BROADSIDE_HD int edges_in(const Polytope& p, const Layer& layer) {
  int count = 0;
  for (int k = 0; k < p.edge_count(); ++k) {
    int from = 0;
    int to = 0;
    p.edge(k, from, to);
    if (reaches_into(p, layer, from, to)) ++count;
  }
  return count;
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
  // An axis across two edges matters where it is wider than that across the best face, so its edges are at most as far
  // apart as the bodies, apart, may be to have points, or overlapping, as they are deep.
  Layer near_a;
  Layer near_b;
  if (a.edge_count() * b.edge_count() > axes_detail::kFewEdgePairs && best.kind != AxisKind::kNone) {
    float thickness = fmaxf(reach_m, -best.gap_m) - best.gap_m + rounding_m;
    for (int halvings = 0; halvings < axes_detail::kMostHalvings; ++halvings) {
      near_a = layer_of(a, best.normal, thickness);
      near_b = layer_of(b, -best.normal, thickness);
      if (axes_detail::edges_in(a, near_a) * axes_detail::edges_in(b, near_b) <= axes_detail::kMostEdgePairs) break;
      thickness = 0.5F * thickness;
    }
  } else {
    near_a.direction = near_b.direction = {0.0F, 0.0F, 0.0F};
  }
  for (int i = 0; i < a.edge_count(); ++i) {
    int a0 = 0;
    int a1 = 0;
    a.edge(i, a0, a1);
    if (!reaches_into(a, near_a, a0, a1)) continue;
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
      if (!reaches_into(b, near_b, b0, b1)) continue;
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

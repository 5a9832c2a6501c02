// The separating axis of two polytopes of any kind: normal to a face of either, or perpendicular to an edge of each.
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
#include "core/method/rigid/near_bound.hpp"
#include "core/method/rigid/nearest_features.hpp"
#include "core/method/rigid/separating_axis.hpp"

namespace broadside::core {

namespace axes_detail {

// Whether two edges, one of each body, cross as arcs on the sphere of directions; an edge's arc joins the normals of
// its two faces. b_left and b_right are negated normals.
BROADSIDE_HD bool arcs_cross(Vec3 a_left, Vec3 a_right, Vec3 b_left, Vec3 b_right) {
  const Vec3 across_a = cross(a_right, a_left);
  const Vec3 across_b = cross(b_right, b_left);
  const float cba = dot(b_left, across_a);
  const float dba = dot(b_right, across_a);
  const float adc = dot(a_left, across_b);
  const float bdc = dot(a_right, across_b);
  return cba * dba <= 0.0F && adc * bdc <= 0.0F && cba * bdc >= 0.0F;
}

// Whether a direction across the edge between two faces lies between their normals. Around the edge of a sheet every
// direction does.
BROADSIDE_HD bool lies_between(Vec3 n, Vec3 left, Vec3 right) {
  const Vec3 middle = cross(left, right);
  if (left + right == Vec3{}) return true;
  return dot(n, left + right) > 0.0F && dot(middle, cross(left, n)) >= 0.0F && dot(middle, cross(n, right)) >= 0.0F;
}

// The face that looks most at a point comes first: its gap is near the widest. A face is skipped if one of the last few
// lowest corners is less far in front of it than the best gap so far: then its gap is no wider.
template <typename Reference, typename Other>
BROADSIDE_HD_CALLED SeparatingAxis axis_of_faces(const Reference& reference, const Other& other, bool reference_is_a,
                                                 float rounding_m) {
  constexpr int kKept = 4;
  SeparatingAxis best;
  Vec3 standing_out[kKept];
  for (int k = 0; k < kKept; ++k) standing_out[k] = reference.local_point(other.corner(0));
  int seen = 0;
  const auto may_be_wider = [&](int k) {
    const float least = best.gap_m - rounding_m;
    bool may = true;
    for (int c = 0; c < kKept; ++c) may &= reference.height_over(k, standing_out[c]) > least;
    return may;
  };
  const auto measure = [&](int k) {
    const Vec3 out = reference.face_normal(k);
    const float height = reference.face_height(k);
    const int lowest = lowest_corner(other, out);
    standing_out[seen++ % kKept] = reference.local_point(other.corner(lowest));
    const float gap = other.least_at(lowest, out) - height;
    if (!(gap > best.gap_m)) return;
    if (reference_is_a)
      best = {gap, -out, AxisKind::kFaceOfA, k, 0};
    else
      best = {gap, out, AxisKind::kFaceOfB, 0, k};
  };
  using Lanes = typename Reference::Lanes;
  const int first = Lanes::first_least(reference.face_count(), [&](int k) {
                      return reference.face_height(k) - dot(reference.face_normal(k), other.center);
                    }).item;
  if (reference.face_count() > 0 && may_be_wider(first)) measure(first);
  Lanes::each_in_turn(
      reference.face_count(), [&](int k) { return k != first && may_be_wider(k); }, measure);
  return best;
}

// Up to this many pairs of edges (two boxes have 144), all pairs are tried, wherever the edges are.
inline constexpr int kFewEdgePairs = 256;

// Edges of large hulls are compared while there are at most so many pairs of them (0.05 s on a slow core). There are
// more only where bodies are deep inside each other; then the edges farthest inside are left out, and the depth is that
// across a face.
inline constexpr int kMostEdgePairs = 1 << 16;
// After this many halvings a layer is as thin as rounding.
inline constexpr int kMostHalvings = 24;

template <typename Polytope>
BROADSIDE_HD bool is_in(const Polytope& p, const Layer& layer, int k) {
  int from = 0;
  int to = 0;
  p.edge(k, from, to);
  return reaches_into(p, layer, from, to);
}

template <typename Polytope>
BROADSIDE_HD int edges_in(const Polytope& p, const Layer& layer) {
  return Polytope::Lanes::count_of(p.edge_count(), [&](int k) { return is_in(p, layer, k); });
}

// The radius of the largest ball about the mesh's origin inside the body; 0 if the origin is not inside.
template <typename Hull>
BROADSIDE_HD float inner_radius_m(const Hull& p) {
  const float least = Hull::Lanes::first_least(p.face_count(), [&](int k) { return p.hull.faces[k].offset_m; }).value;
  return least > 0.0F ? least : 0.0F;
}

// For bodies that overlap along the axis of the best face: how far above a body's lowest corner along that axis edges
// may lie that make a wider axis, with a gap of at least -farthest_m and at most apart_m. The points of two such edges
// lie on their axis, A's lower by the overlap. So for an axis within a right angle of that of the face, A's point is no
// higher than B's highest. Along other axes the balls inside both bodies overlap by more, unless both bodies are flat.
template <typename HullA, typename HullB>
BROADSIDE_HD float layer_of_overlap_m(const HullA& a, const HullB& b, const SeparatingAxis& best, float farthest_m,
                                      float apart_m) {
  const Vec3 between = a.center - b.center;
  const float distance = length(between);
  float back = 1.0F;  // the largest cosine against the axis of the face
  const float least = inner_radius_m(a) + inner_radius_m(b) - farthest_m;
  const float height = dot(best.normal, between);
  if (least > 0.0F && height > 0.0F && distance > 0.0F) {
    const float cosine = fminf(least / distance, 1.0F);
    const float of_face = fminf(height / distance, 1.0F);
    back = sqrtf((1.0F - cosine * cosine) * (1.0F - of_face * of_face)) - cosine * of_face;
    back = fminf(fmaxf(back + 0x1p-10F, 0.0F), 1.0F);
  }
  return fmaxf(apart_m, back * farthest_m) - best.gap_m;
}

struct PlacedEdge {
  int index = 0;
  Vec3 start;
  Vec3 along;  // from end to end
  float half_length = 0.0F;
  Vec3 left;  // normals of its faces
  Vec3 right;
};

template <typename Polytope>
BROADSIDE_HD PlacedEdge place(const Polytope& p, int k) {
  PlacedEdge out;
  int from = 0;
  int to = 0;
  p.edge(k, from, to);
  out.index = k;
  out.start = p.corner(from);
  out.along = p.corner(to) - out.start;
  out.half_length = 0.5F * length(out.along);
  if (p.face_count() > 0) {
    int left = 0;
    int right = 0;
    p.edge_faces(k, left, right);
    out.left = p.face_normal(left);
    out.right = p.face_normal(right);
  }
  return out;
}

// Sets n to the unit direction from B to A across two edges that make a face of the difference of both bodies. False if
// they make none, or are parallel.
BROADSIDE_HD_CALLED bool across(const PlacedEdge& a, bool a_is_solid, const PlacedEdge& b, bool b_is_solid, Vec3& n) {
  if (a_is_solid && b_is_solid && !arcs_cross(a.left, a.right, -b.left, -b.right)) return false;
  const Vec3 product = cross(a.along, b.along);
  const float squared = dot(product, product);
  if (!(squared > kParallelSine * kParallelSine * (dot(a.along, a.along) * dot(b.along, b.along)))) return false;
  n = across_edges(a.along, b.along, a.start - b.start);
  if (a_is_solid ? dot(n, a.left + a.right) > 0.0F : (b_is_solid && dot(n, b.left + b.right) < 0.0F)) n = -n;
  if (b_is_solid && !a_is_solid && !lies_between(n, b.left, b.right)) return false;
  return !(a_is_solid && !b_is_solid) || lies_between(-n, a.left, a.right);
}

// Bounds of the distance, by searches for the lowest corner. A prism's gap is that of the round body.
template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD_CALLED HullGap gap_of_corners(const PolytopeA& a, const PolytopeB& b, float stop_m, float rounding_m) {
  constexpr float kThin = 0x1p-6F;
  HullSearch search = begin_search_toward(a.center - b.center);
  search_by(search, stop_m, kThin, rounding_m, [&](const HullSearch& s) {
    const int of_a = lowest_corner(a, s.n);
    const int of_b = lowest_corner(b, -s.n);
    return FarthestPoints{a.corner(of_a) - b.corner(of_b), a.least_at(of_a, s.n) + b.least_at(of_b, -s.n)};
  });
  search.gap.normal = search.best;
  return search.gap;
}

}  // namespace axes_detail

// For two segments, which have no faces, there may be no axis.
template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD_CALLED SeparatingAxis separating_axis(const PolytopeA& a, const PolytopeB& b, float rounding_m,
                                                   float reach_m) {
  SeparatingAxis best = axes_detail::axis_of_faces(a, b, true, rounding_m);
  if (best.gap_m > reach_m) return best;
  const SeparatingAxis faces_of_b = axes_detail::axis_of_faces(b, a, false, rounding_m);
  if (best.kind == AxisKind::kNone || faces_of_b.gap_m > best.gap_m + rounding_m) best = faces_of_b;
  if (best.gap_m > reach_m) return best;
  SeparatingAxis edges;
  // An axis across two edges matters only if its gap is wider than that of the best face. So its edges are no farther
  // apart than reach_m if the bodies are apart, and no farther than the overlap if they overlap.
  float farthest = 1.0e18F;
  Layer near_a;
  Layer near_b;
  if (a.edge_count() * b.edge_count() > axes_detail::kFewEdgePairs && best.kind != AxisKind::kNone) {
    // Edges farther apart than reach_m are left out below, so bodies that only such edges part are told here. Before,
    // two cylinders that were 99 mm apart, and overlapped along the normals of all faces, had a point 10 mm deep. Of
    // finely cut hulls only those that are not clearly apart come here (hull_manifold.hpp).
    if (!(kIsHull<PolytopeA> && kIsHull<PolytopeB> && has_many_edges(a, b))) {
      const float surely_m = reach_m + 4.0F * rounding_m;
      const HullGap gap = axes_detail::gap_of_corners(a, b, surely_m, rounding_m);
      if (gap.least_m > surely_m) return {gap.least_m, gap.normal, AxisKind::kPoints};
    }
    NearBound bound{best.normal, best.gap_m, fmaxf(reach_m, -best.gap_m)};
    if (has_many_edges(a, b) && best.gap_m > 0.0F) {
      bound = near_bound(a, b, best.normal, best.gap_m, rounding_m);
      bound.farthest_m = fminf(reach_m, bound.farthest_m + 3.0F * rounding_m);
      // No axis has a gap wider than the distance of the bodies.
      if (!(bound.farthest_m > best.gap_m + 4.0F * rounding_m)) return best;
    }
    farthest = bound.farthest_m + rounding_m;
    float thickness = farthest - bound.parted_m;
    if constexpr (kIsHull<PolytopeA> && kIsHull<PolytopeB>) {
      // No face's axis separates the bodies, so edges that matter are no farther apart than the larger of the bound of
      // the distance and the overlap.
      if (has_many_edges(a, b) && !(best.gap_m > 0.0F)) {
        const float apart_m = near_bound(a, b, best.normal, best.gap_m, rounding_m).farthest_m + 4.0F * rounding_m;
        farthest = fminf(bound.farthest_m, fmaxf(apart_m, -best.gap_m)) + rounding_m;
        thickness = axes_detail::layer_of_overlap_m(a, b, best, farthest, apart_m + rounding_m);
      }
    }
    for (int halvings = 0; halvings < axes_detail::kMostHalvings; ++halvings) {
      near_a = layer_of(a, bound.parting, thickness);
      near_b = layer_of(b, -bound.parting, thickness);
      if (axes_detail::edges_in(a, near_a) * axes_detail::edges_in(b, near_b) <= axes_detail::kMostEdgePairs) break;
      thickness = 0.5F * thickness;
    }
  } else {
    near_a.direction = near_b.direction = {0.0F, 0.0F, 0.0F};
  }
  // Edges of B are taken a Handful at a time, so that an edge of A is visited once for many of them.
  using axes_detail::PlacedEdge;
  using Lanes = LanesOf<PolytopeA, PolytopeB>;
  typename Lanes::template Handful<PlacedEdge> of_b;
  for (int j = 0; j < b.edge_count();) {
    j = of_b.fill_with(
        j, b.edge_count(), [&](int k) { return axes_detail::is_in(b, near_b, k); },
        [&](int k) { return axes_detail::place(b, k); });
    if (of_b.count == 0) continue;
    const auto meet_edge = [&](const PlacedEdge& edge_a) {
      Vec3 n;
      const auto makes_axis = [&](const PlacedEdge& edge_b) {
        const Vec3 between = (edge_a.start + 0.5F * edge_a.along) - (edge_b.start + 0.5F * edge_b.along);
        const float most = farthest + edge_a.half_length + edge_b.half_length;
        if (dot(between, between) > most * most) return false;
        if (!axes_detail::across(edge_a, a.face_count() > 0, edge_b, b.face_count() > 0, n)) return false;
        // A sheet has no inside that would say on which side the other body is.
        if constexpr (PolytopeA::kIsSheet || PolytopeB::kIsSheet) return true;
        return dot(n, edge_a.start - edge_b.start) > edges.gap_m;
      };
      of_b.each_in_turn(makes_axis, [&](const PlacedEdge& edge_b) {
        (void)axes_detail::across(edge_a, a.face_count() > 0, edge_b, b.face_count() > 0, n);
        if constexpr (PolytopeA::kIsSheet || PolytopeB::kIsSheet) {
          const float back = gap_along(a, b, -n);
          if (back > edges.gap_m) edges = {back, -n, AxisKind::kEdges, edge_a.index, edge_b.index};
        }
        if (!(dot(n, edge_a.start - edge_b.start) > edges.gap_m)) return;
        const float gap = gap_along(a, b, n);
        if (gap > edges.gap_m) edges = {gap, n, AxisKind::kEdges, edge_a.index, edge_b.index};
      });
    };
    Lanes::template each_made<PlacedEdge>(
        a.edge_count(), [&](int k) { return axes_detail::is_in(a, near_a, k); },
        [&](int k) { return axes_detail::place(a, k); }, meet_edge);
  }
  return edges.gap_m > best.gap_m + rounding_m ? edges : best;
}

}  // namespace broadside::core

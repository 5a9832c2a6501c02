// The manifold of two polytopes, given the direction in which they are farthest apart. A ball may be around each point
// of a polytope: a capsule is a segment with such balls.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/face_clipping.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/nearest_features.hpp"
#include "core/method/rigid/separating_axis.hpp"
#include "core/method/rigid/tilted_contacts.hpp"

namespace broadside::core {

namespace polytope_detail {

// Adds the balls around the points: the surfaces move towards each other, and the middle moves by half the difference
// of the radii.
BROADSIDE_HD ManifoldPoint with_balls(ManifoldPoint p, Vec3 normal, float ball_a_m, float ball_b_m) {
  if (ball_a_m == 0.0F && ball_b_m == 0.0F) return p;
  p.point = p.point + (0.5F * (ball_b_m - ball_a_m)) * normal;
  p.gap_m = p.gap_m - (ball_a_m + ball_b_m);
  return p;
}

template <int kRoom>
BROADSIDE_HD float least_gap(const CommonArea<kRoom>& area) {
  float least = 3.402823e38F;
  for (int k = 0; k < area.count; ++k) least = fminf(least, area.points[k].gap_m);
  return least;
}

// The face of each body that looks along the axis most.
struct FacingFaces {
  int of_a = 0;
  int of_b = 0;
};

template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD FacingFaces facing_faces(const PolytopeA& a, const PolytopeB& b, const SeparatingAxis& axis) {
  if (axis.has_faces) return {axis.face_of_a, axis.face_of_b};
  return {axis.kind == AxisKind::kFaceOfA ? axis.of_a : a.support_face(-axis.normal),
          axis.kind == AxisKind::kFaceOfB ? axis.of_b : b.support_face(axis.normal)};
}

template <typename PolytopeA, typename PolytopeB, int kRoom>
BROADSIDE_HD_CALLED void area_of(const PolytopeA& a, const PolytopeB& b, const SeparatingAxis& axis, FacingFaces faces,
                                 float rounding_m, CommonArea<kRoom>& area) {
  area.count = 0;
  if (axis.kind != AxisKind::kFaceOfB) common_area(a, faces.of_a, b, faces.of_b, axis.normal, true, rounding_m, area);
  if (area.count == 0) common_area(b, faces.of_b, a, faces.of_a, axis.normal, false, rounding_m, area);
}

// The corner of the other body that is deepest along the axis, if it is over the reference's face; where bodies overlap
// it is, whatever rounding says. Where a hull has many faces, this corner need not be one of the incident face.
template <typename Reference, typename Incident>
BROADSIDE_HD_CALLED bool corner_over_face(const Reference& reference, const Incident& incident,
                                          const SeparatingAxis& axis, int face, bool reference_is_a, float rounding_m,
                                          ManifoldPoint& out) {
  const Vec3 outward = reference_is_a ? -axis.normal : axis.normal;
  const int deepest = lowest_corner(incident, outward);
  const Vec3 p = incident.corner(deepest);
  const int sides = reference.face_corner_count(face);
  for (int k = 0; k < sides && axis.gap_m > 0.0F; ++k) {
    const Vec3 start = reference.corner(reference.face_corner(face, k));
    const Vec3 end = reference.corner(reference.face_corner(face, k + 1 == sides ? 0 : k + 1));
    const Vec3 side = cross(end - start, outward);
    if (dot(side, p - start) > rounding_m * length(side)) return false;
  }
  const std::uint32_t plane = face_name(static_cast<std::uint32_t>(face));
  const std::uint32_t corner = corner_name(static_cast<std::uint32_t>(deepest));
  out = {p - (0.5F * axis.gap_m) * outward, axis.gap_m,
         reference_is_a ? feature_key(plane, corner) : feature_key(corner, plane)};
  return true;
}

}  // namespace polytope_detail

// The nearest points of two bodies that are apart, if they are known already.
struct NearestPoints {
  Vec3 on_a;
  Vec3 on_b;
  std::uint32_t feature = 0;
};

// Points whose gap is at most reach_m, after the balls are counted. The distance of the deepest one is that of the
// bodies: where two corners, or a corner and an edge, are nearest, no axis shows this distance, and the direction
// between them becomes the normal, unless faces over each other are nearly as near (is_nearly_shown). nearest: the
// bodies' nearest points, or null.
template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD_CALLED void polytope_manifold(const PolytopeA& a, const PolytopeB& b, const SeparatingAxis& axis,
                                           float ball_a_m, float ball_b_m, float rounding_m, float reach_m,
                                           Manifold& out, const NearestPoints* nearest = nullptr) {
  const float balls_m = ball_a_m + ball_b_m;
  out.count = 0;
  if (axis.kind == AxisKind::kNone || !(axis.gap_m - balls_m <= reach_m)) return;
  out.normal = axis.normal;
  constexpr int kRoom = PolytopeA::kMostFaceCorners + PolytopeB::kMostFaceCorners + 1;
  CommonArea<kRoom> area;
  polytope_detail::FacingFaces faces = polytope_detail::facing_faces(a, b, axis);
  polytope_detail::area_of(a, b, axis, faces, rounding_m, area);
  ManifoldPoint witness;
  bool has_witness = false;
  if (axis.kind == AxisKind::kEdges) {
    int a0 = 0;
    int a1 = 0;
    int b0 = 0;
    int b1 = 0;
    if (axis.has_ends) {
      a0 = axis.ends_of_a[0];
      a1 = axis.ends_of_a[1];
      b0 = axis.ends_of_b[0];
      b1 = axis.ends_of_b[1];
    } else {
      a.edge(axis.of_a, a0, a1);
      b.edge(axis.of_b, b0, b1);
    }
    const EdgeCrossing crossing = edge_crossing(a.corner(a0), a.corner(a1), b.corner(b0), b.corner(b1));
    bool is_crossing = crossing.is_inside;
    // Every direction around the edge of a sheet is one of its normals, so another corner may be deeper.
    if constexpr (PolytopeA::kIsSheet || PolytopeB::kIsSheet)
      is_crossing &= dot(axis.normal, crossing.on_a - crossing.on_b) <= axis.gap_m + 2.0F * rounding_m;
    // Edges of bodies that overlap cross each other, whatever rounding says.
    has_witness = is_crossing || axis.gap_m <= 0.0F;
    witness = {middle_of(crossing.on_a, crossing.on_b, axis.normal, axis.gap_m, ball_a_m > ball_b_m), axis.gap_m,
               feature_key(edge_name(static_cast<std::uint32_t>(a0), static_cast<std::uint32_t>(a1)),
                           edge_name(static_cast<std::uint32_t>(b0), static_cast<std::uint32_t>(b1)))};
  }
  if (polytope_detail::least_gap(area) > axis.gap_m + 2.0F * rounding_m) {
    if (axis.kind == AxisKind::kFaceOfA)
      has_witness = polytope_detail::corner_over_face(a, b, axis, axis.of_a, true, rounding_m, witness);
    if (axis.kind == AxisKind::kFaceOfB)
      has_witness = polytope_detail::corner_over_face(b, a, axis, axis.of_b, false, rounding_m, witness);
  }
  // Whether there is a point as deep as the axis says; its gap is then the distance.
  const bool is_shown = has_witness || polytope_detail::least_gap(area) <= axis.gap_m + 2.0F * rounding_m;
  if (nearest != nullptr && (!is_shown || axis.kind == AxisKind::kPoints)) {
    has_witness = true;
    witness = {middle_of(nearest->on_a, nearest->on_b, axis.normal, axis.gap_m, ball_a_m > ball_b_m), axis.gap_m,
               nearest->feature};
  } else if (!is_shown) {
    if constexpr (LanesOf<PolytopeA, PolytopeB>::kLeavesHardPairs) {
      out.count = kLeft;
      return;
    }
    const NearestDirection near =
        nearest_direction(a, b, axis.normal, axis.gap_m, rounding_m, reach_m + balls_m + 2.0F * rounding_m);
    if (!(near.gap_m > -3.0e38F)) return;  // no features are within reach
    const float distance_m = sqrtf(near.features.squared_m2);
    // Where bodies overlap, or touch so that the direction would be rounding alone, the axis is kept.
    const bool is_wider = axis.gap_m > 0.0F && near.gap_m > axis.gap_m;
    has_witness =
        !(is_wider && balls_m == 0.0F && is_nearly_shown(axis.gap_m, polytope_detail::least_gap(area), distance_m));
    witness.gap_m = axis.gap_m;
    witness.feature = feature_key(near.features.name_a, near.features.name_b);
    if (has_witness && is_wider) {
      out.normal = near.normal;
      witness.gap_m = distance_m;
      area.count = 0;
      faces = {a.support_face(-out.normal), b.support_face(out.normal)};
    }
    witness.point = middle_of(near.features.on_a, near.features.on_b, out.normal, witness.gap_m, ball_a_m > ball_b_m);
  }
  if (has_witness && area.count < kRoom && !(polytope_detail::least_gap(area) <= witness.gap_m + rounding_m))
    area.points[area.count++] = witness;
  const auto at = [&](const ManifoldPoint& p) {
    return polytope_detail::with_balls(p, out.normal, ball_a_m, ball_b_m);
  };
  if constexpr (!PolytopeA::kIsSheet && !PolytopeB::kIsSheet) {
    if (has_many_edges(a, b)) {
      TiltedContacts more;
      tilted_contacts(a, b, out.normal, unit_across(out.normal), faces.of_a, faces.of_b, rounding_m, reach_m + balls_m,
                      more);
      return keep_four_by<LanesOf<PolytopeA, PolytopeB>>(
          out, area.count + more.count, reach_m, kTurnOfStep,
          [&](int k) { return at(k < area.count ? area.points[k] : more.points[k - area.count]); },
          [](int) { return true; });
    }
  }
  keep_four(out, area.count, reach_m, [&](int k) { return at(area.points[k]); });
}

}  // namespace broadside::core

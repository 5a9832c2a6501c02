// The manifold of two boxes, given the direction in which they are farthest apart.
//
// The points and keys are the same as those that polytope_manifold.hpp makes of the boxes as polytopes; box_area.hpp
// and box_nearest.hpp compute them faster. The keys must be the same too, because they order the points of a patch, and
// a response solves points in that order.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/kept_loop.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/box_area.hpp"
#include "core/method/rigid/box_nearest.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/nearest_features.hpp"
#include "core/method/rigid/polytopes.hpp"
#include "core/method/rigid/separating_axis.hpp"

namespace broadside::core {

namespace box_detail {

// Inserts a point in the order of the keys, so that the order stays while the same four points are kept.
BROADSIDE_HD void add_in_order(Manifold& out, const ManifoldPoint& p) {
  int place = out.count;
  for (; place > 0 && p.feature < out.points[place - 1].feature; --place) out.points[place] = out.points[place - 1];
  out.points[place] = p;
  ++out.count;
}

}  // namespace box_detail

// Points whose gap is at most reach_m; the least gap is the distance.
BROADSIDE_HD_CALLED void box_manifold(const BoxPolytope& a, const BoxPolytope& b, const SeparatingAxis& axis,
                                      float rounding_m, float reach_m, Manifold& out) {
  using namespace box_detail;
  out.count = 0;
  if (axis.kind == AxisKind::kNone || !(axis.gap_m <= reach_m)) return;
  out.normal = axis.normal;
  // Where two edges touch, a face of A is the reference: of a box's faces, the one that looks along a direction most is
  // never steep against it.
  const bool reference_is_a = axis.kind != AxisKind::kFaceOfB;
  const BoxPolytope& reference = reference_is_a ? a : b;
  const BoxPolytope& incident = reference_is_a ? b : a;
  const Vec3 outward = reference_is_a ? -axis.normal : axis.normal;
  int face = axis.kind == AxisKind::kFaceOfA ? axis.of_a : axis.of_b;
  if (axis.kind == AxisKind::kEdges) face = reference.support_face(outward);
  const FlatView view = flat_view(reference, face, incident, incident.support_face(-outward), outward);
  const Vec3 plane = reference.face_normal(face);
  FlatArea area;
  FlatPoint deepest;
  common_area_of(view, plane, rounding_m, area, deepest);
  float least = 3.402823e38F;
  BROADSIDE_KEPT_LOOP
  for (int k = 0; k < area.count; ++k) least = fminf(least, area.points[k].gap_m);

  // A point that is as deep as the axis says. Such a point must exist, because its gap is the distance of the bodies.
  ManifoldPoint witness;
  bool has_witness = false;
  bool is_shown = least <= axis.gap_m + 2.0F * rounding_m;
  if (axis.kind == AxisKind::kEdges) {
    int a0 = 0;
    int a1 = 0;
    int b0 = 0;
    int b1 = 0;
    a.edge(axis.of_a, a0, a1);
    b.edge(axis.of_b, b0, b1);
    const EdgeCrossing crossing = edge_crossing(a.corner(a0), a.corner(a1), b.corner(b0), b.corner(b1));
    // Edges of boxes that overlap cross each other, whatever rounding says.
    has_witness = crossing.is_inside || axis.gap_m <= 0.0F;
    witness = {middle_of(crossing.on_a, crossing.on_b, axis.normal, axis.gap_m, false), axis.gap_m,
               feature_key(edge_name(static_cast<std::uint32_t>(a0), static_cast<std::uint32_t>(a1)),
                           edge_name(static_cast<std::uint32_t>(b0), static_cast<std::uint32_t>(b1)))};
  } else if (!is_shown && axis.gap_m <= 0.0F && (area.count > 0 || axis.gap_m < -2.0F * rounding_m)) {
    // Where boxes overlap, the deepest corner is over the face, whatever rounding says. This does not hold where they
    // just touch, edge at edge, and rounding alone says that they overlap: then that corner may lie a whole side beside
    // the face.
    has_witness = true;
    witness = {(view.reference.middle + deepest.u * view.reference.u) +
                   (deepest.w * view.reference.w + (0.5F * deepest.gap_m) * outward),
               axis.gap_m, key_of(view, reference, incident, deepest.made_by, reference_is_a)};
  }
  is_shown |= has_witness;
  if (!is_shown) {
    const NearestOfBoxes near = nearest_of_boxes(a, b, rounding_m);
    has_witness = !(near.gap_m > axis.gap_m && is_nearly_shown(axis.gap_m, least, near.distance_m));
    witness.gap_m = axis.gap_m;
    witness.feature = feature_key(near.name_a, near.name_b);
    // Where the boxes touch, the direction between their points is rounding alone: then the axis is kept.
    if (has_witness && near.gap_m > axis.gap_m) {
      out.normal = near.normal;
      witness.gap_m = near.distance_m;
      area.count = 0;
      least = 3.402823e38F;
    }
    witness.point = middle_of(near.on_a, near.on_b, out.normal, witness.gap_m, false);
  }
  if (has_witness && area.count < kRoom && !(least <= witness.gap_m + rounding_m)) {
    FlatPoint shown = flat(view, plane, witness.point - view.reference.middle);
    shown.gap_m = witness.gap_m;
    shown.made_by = kShown;
    area.points[area.count++] = shown;
  }
  int picked[4];
  const int count = pick_four(area, view.out_u, view.out_w, reach_m, picked);
  BROADSIDE_KEPT_LOOP
  for (int k = 0; k < count; ++k) {
    const FlatPoint p = area.points[picked[k]];
    if (p.made_by == kShown) {
      add_in_order(out, witness);
      continue;
    }
    const Vec3 on_face = view.reference.middle + (p.u * view.reference.u + p.w * view.reference.w);
    add_in_order(out, {on_face + (0.5F * p.gap_m) * outward, p.gap_m,
                       key_of(view, reference, incident, p.made_by, reference_is_a)});
  }
}

}  // namespace broadside::core

// A cylinder against capsules, boxes, hulls and cylinders.
//
// The separating axis is searched with a prism in place of the cylinder. Pass by pass, the prism's corners are gathered
// where the last pass touched. The gap along each axis is measured with the extent of the round body, so no prism makes
// a gap too wide. The last prism differs from the round body by two roundings.
//
// The points are those of the round surfaces: the ends of the line on which a lying cylinder touches; the sixteen
// corners of an end that lies on a face (they turn with the body, so they keep their names); and the deepest point,
// wherever on the rim it is.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/method/rigid/capsule_manifold.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/cylinder_polytope.hpp"
#include "core/method/rigid/face_clipping.hpp"
#include "core/method/rigid/manifold.hpp"
#include "core/method/rigid/point_nearest.hpp"
#include "core/method/rigid/polytope_axes.hpp"
#include "core/method/rigid/polytope_manifold.hpp"
#include "core/method/rigid/round_gap.hpp"

namespace broadside::core {

namespace cylinder_detail {

inline constexpr int kRoom = 2 * kFaceCorners + 12;

// The other body as a polytope. Only another cylinder has a different one in each pass.
BROADSIDE_HD SegmentPolytope polytope_of(const PlacedShape& p, SegmentPolytope, int, Vec3) {
  return segment_polytope(p);
}
BROADSIDE_HD BoxPolytope polytope_of(const PlacedShape& p, BoxPolytope, int, Vec3) {
  return box_polytope(p);
}
BROADSIDE_HD HullPolytope polytope_of(const PlacedShape& p, HullPolytope, int, Vec3) {
  return hull_polytope(p);
}
BROADSIDE_HD CylinderPolytope polytope_of(const PlacedShape& p, CylinderPolytope, int pass, Vec3 towards) {
  return cylinder_polytope(p, pass, towards);
}

// Whether corners of a face may be points: true for any face of a box or hull and for the ends of a cylinder, never for
// a segment.
template <typename Polytope>
BROADSIDE_HD bool is_flat(const Polytope& p, int) {
  return p.face_count() > 0;
}
BROADSIDE_HD bool is_flat(const CylinderPolytope&, int face) {
  return face < 2;
}

struct Candidates {
  CommonArea<kRoom> area;
  Vec3 normal;
  float rounding_m = 0.0F;

  BROADSIDE_HD void add(const ManifoldPoint& p) {
    if (area.count < kRoom) area.points[area.count++] = p;
  }
  // A point of one body's surface and its distance from the other body.
  BROADSIDE_HD_CALLED void add(Vec3 p, const PlacedShape& other, bool is_on_a, std::uint32_t name) {
    const PointDistance from = point_to_solid(other, p, rounding_m);
    const float facing = dot(from.normal, normal);
    if (!((is_on_a ? facing : -facing) >= kSameNormal)) return;
    add({p - (0.5F * from.gap_m) * from.normal, from.gap_m,
         is_on_a ? feature_key(name, from.name) : feature_key(from.name, name)});
  }
  // Adds a point if it is on both surfaces: where several points of a body are equally deep, the one that was found
  // need not be over the other body.
  BROADSIDE_HD_CALLED void add_if_on_both(Vec3 middle, float gap_m, std::uint32_t key, const PlacedShape& a,
                                          const PlacedShape& b) {
    const Vec3 half = (0.5F * gap_m) * normal;
    if (fabsf(point_to_solid(a, middle + half, rounding_m).gap_m) > 4.0F * rounding_m) return;
    if (fabsf(point_to_solid(b, middle - half, rounding_m).gap_m) > 4.0F * rounding_m) return;
    add({middle, gap_m, key});
  }
  BROADSIDE_HD float least_gap() const { return polytope_detail::least_gap(area); }
};

BROADSIDE_HD bool is_round(const PlacedShape& p) {
  return p.shape->kind == ContactKind::kCapsule || p.shape->kind == ContactKind::kCylinder;
}

// Adds the ends of one body's line that lie beside the other body's line, however deep the bodies are in each other.
BROADSIDE_HD_CALLED void add_beside(Candidates& out, const Vec3 ends[2], const Vec3 others[2], bool is_a) {
  for (int end = 0; end < 2; ++end) {
    const float share = share_nearest(ends[end], others[0], others[1]);
    const Vec3 beside = others[0] + share * (others[1] - others[0]);
    const Vec3 between = is_a ? ends[end] - beside : beside - ends[end];
    const float gap = dot(between, out.normal);
    const Vec3 across = between - gap * out.normal;
    if (!(dot(across, across) <=
          0.25F * (1.0F - kSameNormal * kSameNormal) * gap * gap + out.rounding_m * out.rounding_m))
      continue;
    const std::uint32_t name = corner_name(static_cast<std::uint32_t>(end));
    const std::uint32_t other = share == 0.0F ? corner_name(0) : (share == 1.0F ? corner_name(1) : edge_name(0, 1));
    out.add({0.5F * (ends[end] + beside), gap, is_a ? feature_key(name, other) : feature_key(other, name)});
  }
}

// Adds the part of a line that lies over the round end of a cylinder (0 = lower, 1 = upper), seen along the normal. The
// line is clipped by the rim in closed form.
BROADSIDE_HD_CALLED bool add_line_over_end(Candidates& out, const Vec3 ends[2], const PlacedShape& cylinder, int end,
                                           bool line_is_a) {
  const Vec3 n = line_is_a ? out.normal : -out.normal;  // out of the cylinder
  const Vec3 plane = end == 0 ? -cylinder.axes[cylinder.shape->axis] : cylinder.axes[cylinder.shape->axis];
  const float facing = dot(plane, n);
  if (!(facing >= kSteepestReference)) return false;
  const Vec3 center = cylinder.center + cylinder.shape->half_length_m * plane;
  float gaps[2];
  Vec3 flat[2];  // on the plane, from its center
  for (int k = 0; k < 2; ++k) {
    gaps[k] = dot(plane, ends[k] - center) / facing;
    flat[k] = ends[k] - center - gaps[k] * n;
  }
  const Vec3 d = flat[1] - flat[0];
  const float radius = cylinder.shape->radius_m;
  const float a = dot(d, d);
  const float b = dot(d, flat[0]);
  const float c = dot(flat[0], flat[0]) - radius * radius;
  // A line that passes the rim by no more than rounding touches it.
  const float discriminant = b * b - a * c;
  if (!(a > 0.0F) || !(discriminant >= -2.0F * a * radius * out.rounding_m)) return false;
  const float root = discriminant > 0.0F ? sqrtf(discriminant) : 0.0F;
  const float enters = (-b - root) / a;
  const float leaves = (-b + root) / a;
  if (!(enters < 1.0F) || !(leaves > 0.0F)) return false;
  const std::uint32_t plane_name = face_name(static_cast<std::uint32_t>(end));
  for (int k = 0; k < 2; ++k) {
    const bool is_cut = k == 0 ? enters > 0.0F : leaves < 1.0F;
    const float share = k == 0 ? (is_cut ? enters : 0.0F) : (is_cut ? leaves : 1.0F);
    const Vec3 p = ends[0] + share * (ends[1] - ends[0]);
    const float gap = dot(plane, p - center) / facing;
    const std::uint32_t name =
        is_cut ? edge_name(4, static_cast<std::uint32_t>(k)) : corner_name(static_cast<std::uint32_t>(k));
    out.add({p - (0.5F * gap) * n, gap, line_is_a ? feature_key(name, plane_name) : feature_key(plane_name, name)});
  }
  return true;
}

// Adds the line on which a lying capsule or cylinder touches, clipped by the other body's face, or else the ends of the
// line.
template <typename Polytope>
BROADSIDE_HD_CALLED void add_line(Candidates& out, const PlacedShape& round, const PlacedShape& other,
                                  const Polytope& polytope, bool is_a) {
  const Vec3 towards = is_a ? -out.normal : out.normal;
  Vec3 ends[2];
  if (!capsule_detail::line_end(round, 0, towards, ends[0]) || !capsule_detail::line_end(round, 1, towards, ends[1]))
    return;
  CommonArea<kFaceCorners + 3> line;
  line.count = 0;
  const int face = polytope.support_face(-towards);
  if (other.shape->kind == ContactKind::kCylinder && face < 2 && add_line_over_end(out, ends, other, face, is_a))
    return;
  if (other.shape->kind != ContactKind::kCylinder && is_flat(polytope, face))
    common_area(polytope, face, SegmentPolytope{0.5F * (ends[0] + ends[1]), 0.5F * (ends[1] - ends[0])}, 0, out.normal,
                !is_a, out.rounding_m, line);
  for (int k = 0; k < line.count; ++k) out.add(line.points[k]);
  Vec3 others[2];
  const bool both_lie = is_round(other) && capsule_detail::line_end(other, 0, -towards, others[0]) &&
                        capsule_detail::line_end(other, 1, -towards, others[1]);
  if (both_lie) return add_beside(out, ends, others, is_a);
  for (int end = 0; end < 2 && line.count == 0; ++end)
    out.add(ends[end], other, is_a, corner_name(static_cast<std::uint32_t>(end)));
}

// Adds the ends of the other body's edge that is deepest in a lying cylinder, or of the part of the edge that lies
// between the cylinder's end planes.
template <typename Polytope>
BROADSIDE_HD_CALLED void add_edge_inside(Candidates& out, const PlacedShape& cylinder, const Polytope& polytope) {
  const Vec3 n = out.normal;
  const Vec3 axis = cylinder.axes[cylinder.shape->axis];
  const float upright = dot(n, axis);
  if (!(upright * upright <= 1.0F - kSameNormal * kSameNormal)) return;
  const int lowest = lowest_corner(polytope, -n);
  const Vec3 p = polytope.corner(lowest);
  Vec3 q = p;
  float least = 0.0F;
  std::uint32_t name = corner_name(static_cast<std::uint32_t>(lowest));
  for (int e = 0; e < polytope.edge_count(); ++e) {
    int from = 0;
    int to = 0;
    polytope.edge(e, from, to);
    if (from != lowest && to != lowest) continue;
    const Vec3 end = polytope.corner(from == lowest ? to : from);
    const float along = fabsf(dot(end - p, n)) / length(end - p);
    if (name >= 0x40000000U && !(along < least)) continue;
    least = along;
    q = end;
    name = edge_name(static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to));
  }
  // Between the planes of both ends.
  const float half = cylinder.shape->half_length_m;
  const float at_p = dot(p - cylinder.center, axis);
  const float at_q = dot(q - cylinder.center, axis);
  for (int end = 0; end < 2; ++end) {
    const float at = within(end == 0 ? at_p : at_q, half);
    const float share = at_q == at_p ? static_cast<float>(end) : (at - at_p) / (at_q - at_p);
    if (!(share >= 0.0F && share <= 1.0F)) continue;
    const Vec3 x = p + share * (q - p);
    const float on_axis = dot(x - cylinder.center, axis);
    const Vec3 surface = cylinder.center + on_axis * axis -
                         (cylinder.shape->radius_m / sqrtf(1.0F - upright * upright)) * (n - upright * axis);
    const float gap = dot(n, surface - x);
    out.add({x + (0.5F * gap) * n, gap, feature_key(edge_name(3, static_cast<std::uint32_t>(end)), name)});
  }
}

// Adds the area that an end of the cylinder and a face have in common.
template <typename Polytope>
BROADSIDE_HD_CALLED void add_end_on_face(Candidates& out, const CylinderPolytope& cylinder, const Polytope& polytope) {
  const float upright = dot(out.normal, cylinder.along);
  const int face = polytope.support_face(out.normal);
  if (fabsf(upright) >= kSameNormal && is_flat(polytope, face))
    common_area(cylinder, upright > 0.0F ? 0 : 1, polytope, face, out.normal, true, out.rounding_m, out.area);
}

template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD_CALLED EdgeCrossing crossing_of(const PolytopeA& a, const PolytopeB& b, const SeparatingAxis& axis) {
  int a0 = 0;
  int a1 = 0;
  int b0 = 0;
  int b1 = 0;
  a.edge(axis.of_a, a0, a1);
  b.edge(axis.of_b, b0, b1);
  return edge_crossing(a.corner(a0), a.corner(a1), b.corner(b0), b.corner(b1));
}

template <typename Polytope>
BROADSIDE_HD_CALLED void against(const PlacedShape& cylinder, const PlacedShape& other, Polytope kind, float rounding_m,
                                 float reach_m, Manifold& out) {
  const float ball = other.shape->kind == ContactKind::kCapsule ? other.shape->radius_m : 0.0F;
  out.count = 0;
  Vec3 n = cylinder.center - other.center;
  SeparatingAxis axis;
  EdgeCrossing crossing;  // of the axis's edges, where the axis is across two edges
  CylinderPolytope prism = cylinder_polytope(cylinder, 0, n);
  Polytope polytope = polytope_of(other, kind, 0, n);
  for (int pass = 0; pass < kRimPasses; ++pass) {
    if (pass > 0) {
      const bool crosses = axis.kind == AxisKind::kEdges;
      prism = cylinder_polytope(cylinder, pass, crosses ? crossing.on_a - cylinder.center : -n);
      polytope = polytope_of(other, kind, pass, crosses ? crossing.on_b - other.center : n);
    }
    const SeparatingAxis found = separating_axis(prism, polytope, rounding_m, reach_m + ball);
    // If two gaps differ by rounding alone, the later pass is taken, because its edges are closer to where the bodies
    // touch.
    if (found.kind == AxisKind::kEdges && !(found.gap_m < axis.gap_m - rounding_m))
      crossing = crossing_of(prism, polytope, found);
    if (axis.kind == AxisKind::kNone || found.gap_m > axis.gap_m) axis = found;
    if (axis.gap_m - ball > reach_m) return;
    n = axis.normal;
  }
  Candidates points;
  points.area.count = 0;
  points.rounding_m = rounding_m;
  points.normal = n;
  const CylinderPolytope even = cylinder_polytope(cylinder, 0, n);
  const Polytope even_other = polytope_of(other, kind, 0, n);
  const float upright = dot(n, even.along);
  add_end_on_face(points, even, even_other);
  add_line(points, cylinder, other, even_other, true);
  if (is_round(other)) add_line(points, other, cylinder, even, false);
  // The deepest point of either body over the other.
  const float shown = axis.gap_m - ball + 2.0F * rounding_m;
  if (points.least_gap() > shown) {
    points.add(farthest_of_cylinder(cylinder, -n), other, true, corner_name(upright > 0.0F ? 0 : 1));
    if (other.shape->kind == ContactKind::kCylinder)
      points.add(farthest_of_cylinder(other, n), cylinder, false, corner_name(0));
    else
      points.add(polytope.corner(lowest_corner(polytope, -n)) + ball * n, cylinder, false,
                 corner_name(static_cast<std::uint32_t>(lowest_corner(polytope, -n))));
  }
  const std::uint32_t rim_key = feature_key(edge_name(0, upright > 0.0F ? 1 : 2), edge_name(0, 0));
  if (points.least_gap() > shown && axis.kind == AxisKind::kEdges) {
    // Where the last prisms are coarse, their chords may cross although the rims do not.
    const Vec3 error = crossing.on_a - crossing.on_b - axis.gap_m * n;
    if (dot(error, error) <= 16.0F * rounding_m * rounding_m) {
      const Vec3 middle = middle_of(crossing.on_a, crossing.on_b, n, axis.gap_m, false);
      points.add(polytope_detail::with_balls({middle, axis.gap_m, rim_key}, n, 0.0F, ball));
    }
  }
  // Where the bodies overlap, the deepest corner is over the face that the normal belongs to, even if rounding says
  // otherwise.
  const float gap = axis.gap_m - ball;
  if (points.least_gap() > shown && gap <= 0.0F) {
    const int lowest = lowest_corner(polytope, -n);
    const Vec3 of_other = other.shape->kind == ContactKind::kCylinder ? farthest_of_cylinder(other, n)
                                                                      : polytope.corner(lowest) + ball * n;
    points.add_if_on_both(of_other + (0.5F * gap) * n, gap,
                          feature_key(face_name(2), corner_name(static_cast<std::uint32_t>(lowest))), cylinder, other);
    points.add_if_on_both(farthest_of_cylinder(cylinder, -n) - (0.5F * gap) * n, gap,
                          feature_key(corner_name(upright > 0.0F ? 0 : 1), face_name(0)), cylinder, other);
    if (ball == 0.0F) add_edge_inside(points, cylinder, polytope);
  }
  if (points.least_gap() > shown && axis.gap_m <= 0.0F) {
    const Vec3 p = axis.kind == AxisKind::kEdges ? crossing.on_a : farthest_of_cylinder(cylinder, -n);
    const ManifoldPoint last{p - (0.5F * axis.gap_m) * n, axis.gap_m, rim_key};
    points.add(polytope_detail::with_balls(last, n, 0.0F, ball));
  }
  if (points.least_gap() > shown) {
    // The bodies are apart, and their nearest points are two corners, or a corner and a point of a rim. The normal is
    // the direction between these points, which is found with finer and finer rims.
    NearestDirection near;
    // Each fineness is used twice, because refining either rim moves the nearest points along both.
    for (int pass = 0; pass < 2 * kRimPasses - 1; ++pass) {
      const int fineness = (pass + 1) / 2;
      prism = cylinder_polytope(cylinder, fineness, pass == 0 ? -n : near.features.on_a - cylinder.center);
      polytope = polytope_of(other, kind, fineness, pass == 0 ? n : near.features.on_b - other.center);
      near =
          nearest_direction(prism, polytope, axis.normal, axis.gap_m, rounding_m, reach_m + ball + 2.0F * rounding_m);
      if (!(near.gap_m > -3.0e38F)) break;
    }
    if (!(near.gap_m > -3.0e38F)) return;
    ManifoldPoint witness{{}, axis.gap_m, rim_key};
    if (near.gap_m > axis.gap_m) {
      points.normal = near.normal;
      points.area.count = 0;
      witness.gap_m = sqrtf(near.features.squared_m2);
    }
    witness.point = middle_of(near.features.on_a, near.features.on_b, points.normal, witness.gap_m, false);
    points.add(polytope_detail::with_balls(witness, points.normal, 0.0F, ball));
  }
  out.normal = points.normal;
  keep_four(out, points.area.count, reach_m, [&](int k) { return points.area.points[k]; });
}

}  // namespace cylinder_detail

// The cylinder is A here, whatever the order of the kinds.
template <typename Lanes>
BROADSIDE_HD_CALLED void cylinder_manifold(const PlacedShape& cylinder, const PlacedShape& other, float rounding_m,
                                           float reach_m, Manifold& out) {
  switch (other.shape->kind) {
    case ContactKind::kCapsule:
      return cylinder_detail::against(cylinder, other, SegmentPolytope{}, rounding_m, reach_m, out);
    case ContactKind::kBox:
      return cylinder_detail::against(cylinder, other, BoxPolytope{}, rounding_m, reach_m, out);
    case ContactKind::kCylinder:
      return cylinder_detail::against(cylinder, other, CylinderPolytope{}, rounding_m, reach_m, out);
    default:
      out.count = 0;
      if constexpr (Lanes::kKnowsLongShapes)
        if (other.shape->kind == ContactKind::kHull)
          cylinder_detail::against(cylinder, other, HullPolytope{}, rounding_m, reach_m, out);
  }
}

}  // namespace broadside::core

// The nearest points of two polytopes that are apart, by their corners and edges.
//
// Separating axes find a corner over a face. The other cases are two edges, a corner and an edge, and two corners. All
// such pairs are tried; for large hulls, only those that near_bound.hpp leaves.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_points.hpp"
#include "core/method/rigid/corner_layer.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/near_bound.hpp"

namespace broadside::core {

// How far A is above B along a unit direction.
template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD float gap_along(const PolytopeA& a, const PolytopeB& b, Vec3 n) {
  return a.least(n) + b.least(-n);
}

struct NearestFeatures {
  float squared_m2 = 3.402823e38F;
  Vec3 on_a;
  Vec3 on_b;
  std::uint32_t name_a = 0;
  std::uint32_t name_b = 0;
  // The edges on which the points lie, from end to end; zero at a corner.
  Vec3 along_a;
  Vec3 along_b;
};

namespace nearest_detail {

// Corners of `points` against edges of `edges`; a_has_corner says which of them is A.
template <typename Points, typename Edges>
BROADSIDE_HD void corners_against_edges(const Points& points, const Layer& near_points, const Edges& edges,
                                        const Layer& near_edges, bool a_has_corner, NearestFeatures& best) {
  int from = 0;
  int to = 0;
  const auto is_near = [&](int e) {
    edges.edge(e, from, to);
    return reaches_into(edges, near_edges, from, to);
  };
  Edges::Lanes::each_with(edges.edge_count(), is_near, [&](int e) {
    edges.edge(e, from, to);
    const Vec3 p = edges.corner(from);
    const Vec3 q = edges.corner(to);
    Vec3 x;
    Vec3 y;
    float share = 0.0F;
    const auto measure = [&](int c) {
      x = points.corner(c);
      share = share_nearest(x, p, q);
      y = share == 1.0F ? q : p + share * (q - p);
      return dot(x - y, x - y);
    };
    const FirstLeast nearest = Points::Lanes::first_least(points.corner_count(), [&](int c) {
      return reaches_into(points, near_points, c, c) ? measure(c) : 3.402823e38F;
    });
    if (!(nearest.value < best.squared_m2)) return;
    best.squared_m2 = measure(nearest.item);
    const std::uint32_t corner = corner_name(static_cast<std::uint32_t>(nearest.item));
    const std::uint32_t other = share == 0.0F ? corner_name(static_cast<std::uint32_t>(from))
                                : share == 1.0F
                                    ? corner_name(static_cast<std::uint32_t>(to))
                                    : edge_name(static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to));
    best.on_a = a_has_corner ? x : y;
    best.on_b = a_has_corner ? y : x;
    best.name_a = a_has_corner ? corner : other;
    best.name_b = a_has_corner ? other : corner;
    const Vec3 along = share > 0.0F && share < 1.0F ? q - p : Vec3{};
    best.along_a = a_has_corner ? Vec3{} : along;
    best.along_b = a_has_corner ? along : Vec3{};
  });
}

}  // namespace nearest_detail

// Nearest points of the lines of two edges; a point beyond an end of its edge is moved to that end. For parallel edges
// this has no answer: their nearest points include a corner.
struct EdgeCrossing {
  Vec3 on_a;
  Vec3 on_b;
  bool is_inside = false;  // of both edges
};

BROADSIDE_HD_CALLED EdgeCrossing edge_crossing(Vec3 p0, Vec3 p1, Vec3 q0, Vec3 q1) {
  const Vec3 u = p1 - p0;
  const Vec3 v = q1 - q0;
  const Vec3 w = p0 - q0;
  const float uu = dot(u, u);
  const float vv = dot(v, v);
  const Vec3 n = cross(u, v);
  const float squared = dot(n, n);
  if (!(squared > 0.0F) || !(uu > 0.0F) || !(vv > 0.0F)) return {p0, q0, false};
  // From w + s u - r v parallel to n.
  const float s = dot(cross(v, w), n) / squared;
  const float r = dot(cross(u, w), n) / squared;
  const bool is_inside = s >= 0.0F && s <= 1.0F && r >= 0.0F && r <= 1.0F;
  const float cs = s <= 0.0F ? 0.0F : (s >= 1.0F ? 1.0F : s);
  const float cr = r <= 0.0F ? 0.0F : (r >= 1.0F ? 1.0F : r);
  return {p0 + cs * u, q0 + cr * v, is_inside};
}

template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD NearestFeatures nearest_corner_and_edge(const PolytopeA& a, const Layer& near_a, const PolytopeB& b,
                                                     const Layer& near_b) {
  NearestFeatures best;
  nearest_detail::corners_against_edges(a, near_a, b, near_b, true, best);
  nearest_detail::corners_against_edges(b, near_b, a, near_a, false, best);
  return best;
}

template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD NearestFeatures nearest_edges(const PolytopeA& a, const Layer& near_a, const PolytopeB& b,
                                           const Layer& near_b) {
  NearestFeatures best;
  int a0 = 0;
  int a1 = 0;
  const auto is_near = [&](int i) {
    a.edge(i, a0, a1);
    return reaches_into(a, near_a, a0, a1);
  };
  PolytopeA::Lanes::each_with(a.edge_count(), is_near, [&](int i) {
    a.edge(i, a0, a1);
    const Vec3 p0 = a.corner(a0);
    const Vec3 p1 = a.corner(a1);
    int b0 = 0;
    int b1 = 0;
    Vec3 q0;
    Vec3 q1;
    EdgeCrossing crossing;
    const auto measure = [&](int j) {
      b.edge(j, b0, b1);
      if (!reaches_into(b, near_b, b0, b1)) return 3.402823e38F;
      q0 = b.corner(b0);
      q1 = b.corner(b1);
      crossing = edge_crossing(p0, p1, q0, q1);
      const Vec3 between = crossing.on_a - crossing.on_b;
      return crossing.is_inside ? dot(between, between) : 3.402823e38F;
    };
    const FirstLeast nearest = PolytopeB::Lanes::first_least(b.edge_count(), measure);
    if (!(nearest.value < best.squared_m2)) return;
    best.squared_m2 = measure(nearest.item);
    best.on_a = crossing.on_a;
    best.on_b = crossing.on_b;
    best.name_a = edge_name(static_cast<std::uint32_t>(a0), static_cast<std::uint32_t>(a1));
    best.name_b = edge_name(static_cast<std::uint32_t>(b0), static_cast<std::uint32_t>(b1));
    best.along_a = p1 - p0;
    best.along_b = q1 - q0;
  });
  return best;
}

// The component of d perpendicular to an edge. Rounding moves the two points whose difference is d along the edge, and
// that error, times the edge's length, would be an error of the gap.
BROADSIDE_HD Vec3 without(Vec3 d, Vec3 along) {
  const float squared = dot(along, along);
  return squared > 0.0F ? d - (dot(d, along) / squared) * along : d;
}

// The unit direction perpendicular to both edges, and to the longer one to the last digit; on the side of `between`.
BROADSIDE_HD Vec3 across_edges(Vec3 u, Vec3 v, Vec3 between) {
  const bool u_is_longer = dot(u, u) > dot(v, v);
  Vec3 n = cross(u, v);
  n = without(without(n, u_is_longer ? v : u), u_is_longer ? u : v);
  const float squared = dot(n, n);
  if (!(squared > 0.0F)) return {};
  n = (1.0F / sqrtf(squared)) * n;
  return dot(n, between) < 0.0F ? -n : n;
}

// Two polytopes that are apart, or nearly: their nearest points, and the direction in which they are farthest apart.
struct NearestDirection {
  float gap_m = -3.402823e38F;  // along the normal
  Vec3 normal;                  // unit, from B to A
  NearestFeatures features;
};

// Tries only features that may be nearer than reach_m, given a direction that separates the bodies by parted_m; if
// there are none, the gap stays the lowest number. Where two pairs of features are equally near to within rounding, or
// two ways to compute the direction differ, the direction along which the bodies are farther apart is taken.
template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD_CALLED NearestDirection nearest_direction(const PolytopeA& a, const PolytopeB& b, Vec3 parting,
                                                       float parted_m, float rounding_m, float reach_m) {
  NearestDirection best;
  if (has_many_edges(a, b) && parted_m > 0.0F) {
    const NearBound bound = near_bound(a, b, parting, parted_m, rounding_m);
    parting = bound.parting;
    parted_m = bound.parted_m;
    reach_m = fminf(reach_m, bound.farthest_m + 4.0F * rounding_m);
  }
  const float thickness = reach_m - parted_m > 0.0F ? reach_m - parted_m : 0.0F;
  const Layer near_a = layer_of(a, parting, thickness);
  const Layer near_b = layer_of(b, -parting, thickness);
  const auto attempt = [&](Vec3 direction) {
    const float squared = dot(direction, direction);
    if (!(squared > 0.0F)) return;
    const Vec3 n = (1.0F / sqrtf(squared)) * direction;
    const float gap = gap_along(a, b, n);
    if (!(gap > best.gap_m)) return;
    best.gap_m = gap;
    best.normal = n;
  };
  const NearestFeatures corner = nearest_corner_and_edge(a, near_a, b, near_b);
  const NearestFeatures edges = nearest_edges(a, near_a, b, near_b);
  if (corner.squared_m2 > 3.0e38F && edges.squared_m2 > 3.0e38F) return best;
  best.features = edges.squared_m2 < corner.squared_m2 ? edges : corner;
  if (corner.squared_m2 < 3.0e38F) attempt(without(without(corner.on_a - corner.on_b, corner.along_a), corner.along_b));
  if (edges.squared_m2 < 3.0e38F) attempt(across_edges(edges.along_a, edges.along_b, edges.on_a - edges.on_b));
  // A corner may be found although a point of its edge is nearer, by less than rounding. Then a far end of that edge is
  // lower along the direction than the corner. This shows the error to first order; the distance shows it only to
  // second order.
  for (int round = 0; round < 2 && best.gap_m > 0.0F; ++round) {
    const NearestFeatures& near = best.features;
    const Vec3 n = best.normal;
    const Vec3 u = a.corner(lowest_corner(a, n)) - near.on_a;
    const Vec3 v = b.corner(lowest_corner(b, -n)) - near.on_b;
    Vec3 d = near.on_a - near.on_b;
    if (dot(n, u) < 0.0F) d = without(d, u);
    if (dot(n, v) > 0.0F) d = without(d, v);
    attempt(d);
  }
  return best;
}

// Halfway between the nearest points, on the line along the normal through one of them. That one is the smaller body's,
// because beside a large ball many points are equally near.
BROADSIDE_HD Vec3 middle_of(Vec3 on_a, Vec3 on_b, Vec3 normal, float gap_m, bool through_b) {
  return through_b ? on_b + (0.5F * gap_m) * normal : on_a - (0.5F * gap_m) * normal;
}

}  // namespace broadside::core

// A lower and an upper bound of the distance of two polytopes. Features that are farther apart than the upper bound
// need not be tried.
//
// Gilbert, An iterative procedure for computing the minimum of a quadratic form on a convex set (1966): a point of the
// difference of both bodies moves toward the corner that is farthest in the opposite direction, to the point of the
// segment between them that is nearest to the origin.
#pragma once

#include <cmath>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/corner_layer.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/hull_gap.hpp"
#include "core/method/rigid/polytopes.hpp"

namespace broadside::core {

// Whether finding a bound costs less than trying all pairs of edges. It does not for boxes, and for the prisms that
// stand for cylinders.
template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD bool has_many_edges(const PolytopeA& a, const PolytopeB& b) {
  constexpr int kManyEdgePairs = 4096;
  return a.edge_count() * b.edge_count() > kManyEdgePairs;
}

struct NearBound {
  Vec3 parting;             // unit, from B to A
  float parted_m = 0.0F;    // the bodies are apart by at least this much along it
  float farthest_m = 0.0F;  // their distance is at most this
};

template <typename Polytope>
inline constexpr bool kIsHull = false;
template <typename Lanes>
inline constexpr bool kIsHull<HullPolytopeOf<Lanes>> = true;

// For hulls that have ways (HullView::ways).
template <typename LanesA, typename LanesB>
BROADSIDE_HD NearestOfHulls nearest_of(const HullPolytopeOf<LanesA>& a, const HullPolytopeOf<LanesB>& b,
                                       float rounding_m) {
  if (a.known_gap != nullptr) return *a.known_gap;
  return exact_hull_gap({a.hull, a.center, a.axes}, {b.hull, b.center, b.axes}, rounding_m);
}

// For bodies that are apart by parted_m > 0 along the unit direction `parting`.
template <typename PolytopeA, typename PolytopeB>
BROADSIDE_HD_CALLED NearBound near_bound(const PolytopeA& a, const PolytopeB& b, Vec3 parting, float parted_m,
                                         float rounding_m) {
  // Further steps cost more than they save, because each looks at all corners.
  constexpr int kMostSteps = 24;
  constexpr float kThin = 0x1p-7F;
  if constexpr (kIsHull<PolytopeA> && kIsHull<PolytopeB>) {
    const HullGap gap = nearest_of(a, b, rounding_m).gap;
    if (gap.least_m > parted_m) return {gap.normal, gap.least_m, gap.most_m};
    return {parting, parted_m, gap.most_m};
  }
  NearBound bound{parting, parted_m, 3.402823e38F};
  Vec3 x = a.corner(lowest_corner(a, parting)) - b.corner(lowest_corner(b, -parting));
  for (int step = 0; step < kMostSteps; ++step) {
    const float distance = length(x);
    bound.farthest_m = fminf(bound.farthest_m, distance);
    if (!(distance > 0.0F)) break;
    const Vec3 n = (1.0F / distance) * x;
    const Vec3 corner = a.corner(lowest_corner(a, n)) - b.corner(lowest_corner(b, -n));
    const float gap = dot(n, corner);
    if (gap > bound.parted_m) {
      bound.parted_m = gap;
      bound.parting = n;
    }
    if (bound.farthest_m - bound.parted_m <= kThin * bound.farthest_m) break;
    const float share = share_nearest({}, x, corner);
    if (!(share > 0.0F)) break;
    x = x + share * (corner - x);
  }
  return bound;
}

}  // namespace broadside::core

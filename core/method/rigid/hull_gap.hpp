// A lower and an upper bound of the distance of two hulls, and a lower bound of their overlap; by one lane.
//
// Gilbert, Johnson and Keerthi, A fast procedure for computing the distance between complex objects in
// three-dimensional space (1988): a simplex of the difference of both hulls moves toward the origin. Both numbers hold
// after every step, whatever rounding did before: the lower one is the gap along a direction, the upper one the
// length of a sum of differences of corners whose weights are shares of 1.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/vec3.hpp"
#include "core/method/rigid/contact_shape.hpp"
#include "core/method/rigid/cross.hpp"
#include "core/method/rigid/hull_climb.hpp"
#include "core/method/rigid/simplex.hpp"

namespace broadside::core {

struct HullGap {
  Vec3 normal;                      // unit, from B to A, in axes of the world
  float least_m = -3.402823e38F;    // the hulls are apart by at least this much along it
  float most_m = 3.402823e38F;      // and two of their points are no farther from each other
  float overlap_m = -3.402823e38F;  // a ball of this radius fits around the origin in the difference: depth is no less
};

// The nearest points of two hulls are sums of corners with these weights, the same for both; 4: it is one point, inside
// both; 0: they were not found.
struct NearestCorners {
  int count = 0;
  float weights[4] = {};
  std::uint32_t of_a[4] = {};
  std::uint32_t of_b[4] = {};
};

struct NearestOfHulls {
  HullGap gap;
  NearestCorners corners;
};

struct PlacedHull {
  HullView hull;
  Vec3 center;
  TurnedAxes axes;
};

namespace gap_detail {

// The unit direction of x, the point of the simplex nearest to the origin. It must be across the whole simplex;
// rounding in the sum of the corners tilts it, the more the nearer x is to the origin.
BROADSIDE_HD Vec3 across(const Simplex& simplex, Vec3 x, float length_of_x) {
  const Vec3 n = (1.0F / length_of_x) * x;
  if (simplex.count < 2) return n;
  const Vec3 u = simplex.corners[1] - simplex.corners[0];
  Vec3 exact = n - (dot(n, u) / dot(u, u)) * u;
  if (simplex.count > 2) {
    exact = cross(u, simplex.corners[2] - simplex.corners[0]);
    if (dot(exact, n) < 0.0F) exact = -exact;
  }
  const float size = length(exact);
  exact = (1.0F / size) * exact;
  // The corners of a sliver, or of a point, give no direction.
  return dot(exact, n) > 0.99F ? exact : n;
}

}  // namespace gap_detail

// Stops where they are apart by more than stop_m, or both numbers are within `thin` of the larger one or slack_m of
// each other. Both are hulls that have ways.
BROADSIDE_HD_CALLED NearestOfHulls nearest_of_hulls(const PlacedHull& a, const PlacedHull& b, float stop_m, float thin,
                                                    float slack_m) {
  constexpr int kMostSteps = 32;
  const HullView& hull_a = a.hull;
  const HullView& hull_b = b.hull;
  // Of B in A's axes.
  const Vec3 between = turned_back(a.axes, b.center - a.center);
  const TurnedAxes turn{turned_back(a.axes, b.axes.x), turned_back(a.axes, b.axes.y), turned_back(a.axes, b.axes.z)};
  NearestOfHulls nearest;
  HullGap& out = nearest.gap;
  Vec3 n = -between;
  float distance = length(n);
  if (!(distance > 0.0F)) n = {1.0F, 0.0F, 0.0F};
  n = (distance > 0.0F ? 1.0F / distance : 1.0F) * n;
  std::uint32_t of_a = climb_start(hull_a, n);
  std::uint32_t of_b = climb_start(hull_b, turned_back(turn, -n));
  Simplex simplex;
  Vec3 best = n;
  distance = 3.402823e38F;
  for (int step = 0; step < kMostSteps; ++step) {
    of_a = climb_down(hull_a, n, of_a);
    of_b = climb_down(hull_b, turned_back(turn, -n), of_b);
    const Vec3 corner = hull_a.vertices[of_a] - (between + turned(turn, hull_b.vertices[of_b]));
    const float gap = dot(n, corner);
    if (gap > out.least_m) {
      out.least_m = gap;
      best = n;
    }
    if (out.least_m > stop_m || out.most_m - out.least_m <= fmaxf(thin * out.most_m, slack_m)) break;
    bool is_known = false;
    for (int k = 0; k < simplex.count; ++k) is_known |= simplex.corners[k] == corner;
    if (is_known) break;
    simplex.of_a[simplex.count] = of_a;
    simplex.of_b[simplex.count] = of_b;
    simplex.corners[simplex.count++] = corner;
    float inside_m = 0.0F;
    const Vec3 x = keep_nearest(simplex, inside_m);
    if (inside_m > 0.0F) {
      out.overlap_m = inside_m;
      out.most_m = 0.0F;
      break;
    }
    const float nearer = length(x);
    if (!(nearer < distance)) {
      simplex.count = 0;
      break;
    }
    distance = nearer;
    out.most_m = nearer;
    if (!(nearer > slack_m)) break;
    n = gap_detail::across(simplex, x, nearer);
  }
  out.normal = turned(a.axes, best);
  NearestCorners& corners = nearest.corners;
  corners.count = simplex.count;
  for (int k = 0; k < corners.count; ++k) {
    corners.weights[k] = simplex.weights[k];
    corners.of_a[k] = simplex.of_a[k];
    corners.of_b[k] = simplex.of_b[k];
  }
  return nearest;
}

BROADSIDE_HD HullGap hull_gap(const PlacedHull& a, const PlacedHull& b, float stop_m, float thin, float slack_m) {
  return nearest_of_hulls(a, b, stop_m, thin, slack_m).gap;
}

// As close as rounding allows.
BROADSIDE_HD NearestOfHulls exact_hull_gap(const PlacedHull& a, const PlacedHull& b, float rounding_m) {
  return nearest_of_hulls(a, b, 3.402823e38F, 0.0F, rounding_m);
}

}  // namespace broadside::core

// A lower and an upper bound of the distance of two hulls, and a lower bound of their overlap; by one lane.
//
// Gilbert, Johnson and Keerthi, A fast procedure for computing the distance between complex objects in
// three-dimensional space (1988): a simplex of the difference of both hulls moves toward the origin. Both bounds hold
// after every step, whatever rounding did before: the lower one is the gap along a direction, the upper one the length
// of a sum of differences of corners whose weights are shares of 1.
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
  float least_m = -3.402823e38F;    // a lower bound of the distance: the gap along the normal
  float most_m = 3.402823e38F;      // an upper bound of the distance: that of two of their points
  float overlap_m = -3.402823e38F;  // a lower bound of the depth: a ball this large is in the difference, at the origin
};

// The nearest points of two hulls are sums of corners with these weights, the same for both hulls. A count of 4: both
// points are one, inside both hulls. 0: they were not found.
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

// Where points are nearer to each other than this many allowances for rounding, the direction between them may be
// mostly rounding.
inline constexpr float kClearlyApartRoundings = 4.0F;

struct PlacedHull {
  HullView hull;
  Vec3 center;
  TurnedAxes axes;
};

namespace gap_detail {

// The unit direction of x, the point of the simplex nearest to the origin. It must be perpendicular to the whole
// simplex. Rounding in the sum of the corners tilts it, and the more, the nearer x is to the origin.
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

// A search for the nearest points of two hulls that have ways. It may stop at a bound and go on later, with the same
// result as if it had not stopped.
struct HullSearch {
  Vec3 between;     // from A's center to B's, in A's axes, as are all vectors below
  TurnedAxes turn;  // of B
  Vec3 n;           // unit: the direction in which it looks
  std::uint32_t of_a = 0;
  std::uint32_t of_b = 0;
  Simplex simplex;
  float distance = 3.402823e38F;  // of the simplex
  Vec3 best;                      // the direction of gap.least_m
  HullGap gap;
  int steps = 0;
  bool has_ended = false;
};

// toward: from B to A, axes of the world, of any length: where the search looks first. Zero: along the centers.
BROADSIDE_HD HullSearch begin_search(const PlacedHull& a, const PlacedHull& b, Vec3 toward) {
  HullSearch s;
  s.between = turned_back(a.axes, b.center - a.center);
  s.turn = {turned_back(a.axes, b.axes.x), turned_back(a.axes, b.axes.y), turned_back(a.axes, b.axes.z)};
  s.n = turned_back(a.axes, toward);
  float size = length(s.n);
  if (!(size > 0.0F)) {
    s.n = -s.between;
    size = length(s.n);
  }
  if (!(size > 0.0F)) s.n = {1.0F, 0.0F, 0.0F};
  s.n = (size > 0.0F ? 1.0F / size : 1.0F) * s.n;
  s.best = s.n;
  return s;
}

// A search in the axes of the world, for bodies that are given by their farthest points. toward: from B to A, of any
// length.
BROADSIDE_HD HullSearch begin_search_toward(Vec3 toward) {
  HullSearch s;
  const float size = length(toward);
  s.n = size > 0.0F ? (1.0F / size) * toward : Vec3{1.0F, 0.0F, 0.0F};
  s.best = s.n;
  return s;
}

namespace gap_detail {

// Whether the simplex came nearer to the origin with this corner.
BROADSIDE_HD bool move_nearer(HullSearch& s, Vec3 corner, float slack_m) {
  for (int k = 0; k < s.simplex.count; ++k)
    if (s.simplex.corners[k] == corner) return false;
  s.simplex.of_a[s.simplex.count] = s.of_a;
  s.simplex.of_b[s.simplex.count] = s.of_b;
  s.simplex.corners[s.simplex.count++] = corner;
  float inside_m = 0.0F;
  const Vec3 x = keep_nearest(s.simplex, inside_m);
  if (inside_m > 0.0F) {
    s.gap.overlap_m = inside_m;
    s.gap.most_m = 0.0F;
    return false;
  }
  const float nearer = length(x);
  if (!(nearer < s.distance)) {
    s.simplex.count = 0;
    return false;
  }
  s.distance = nearer;
  s.gap.most_m = nearer;
  if (!(nearer > slack_m)) return false;
  s.n = across(s.simplex, x, nearer);
  return true;
}

}  // namespace gap_detail

// Two points, one of each body, which are farthest toward the other body along a direction.
struct FarthestPoints {
  Vec3 between;        // A's less B's
  float gap_m = 0.0F;  // of the bodies along the direction
};

// Stops when the bodies are apart by more than stop_m, or when the bounds differ by no more than slack_m or the share
// `thin` of the larger one. farthest(s): along s.n.
template <typename Farthest>
BROADSIDE_HD void search_by(HullSearch& search, float stop_m, float thin, float slack_m, const Farthest& farthest) {
  constexpr int kMostSteps = 32;
  HullSearch s = search;
  for (; s.steps < kMostSteps && !s.has_ended; ++s.steps) {
    const FarthestPoints points = farthest(s);
    if (points.gap_m > s.gap.least_m) {
      s.gap.least_m = points.gap_m;
      s.best = s.n;
    }
    if (s.gap.least_m > stop_m || s.gap.most_m - s.gap.least_m <= fmaxf(thin * s.gap.most_m, slack_m)) break;
    s.has_ended = !gap_detail::move_nearer(s, points.between, slack_m);
  }
  search = s;
}

BROADSIDE_HD_CALLED void search_on(const HullView& hull_a, const HullView& hull_b, HullSearch& search, float stop_m,
                                   float thin, float slack_m) {
  search_by(search, stop_m, thin, slack_m, [&](HullSearch& s) {
    s.of_a = lowest_along(hull_a, s.n);
    s.of_b = lowest_along(hull_b, turned_back(s.turn, -s.n));
    const Vec3 corner = hull_a.vertices[s.of_a] - (s.between + turned(s.turn, hull_b.vertices[s.of_b]));
    return FarthestPoints{corner, dot(s.n, corner)};
  });
}

BROADSIDE_HD HullGap gap_of(const HullSearch& search, const PlacedHull& a) {
  HullGap gap = search.gap;
  gap.normal = turned(a.axes, search.best);
  return gap;
}

BROADSIDE_HD HullGap hull_gap(const PlacedHull& a, const PlacedHull& b, float stop_m, float thin, float slack_m,
                              Vec3 toward = {}) {
  HullSearch search = begin_search(a, b, toward);
  search_on(a.hull, b.hull, search, stop_m, thin, slack_m);
  return gap_of(search, a);
}

// As close as rounding allows, from where the search has come to.
BROADSIDE_HD NearestOfHulls exact_hull_gap(const PlacedHull& a, const PlacedHull& b, HullSearch& search,
                                           float rounding_m) {
  search_on(a.hull, b.hull, search, 3.402823e38F, 0.0F, rounding_m);
  NearestOfHulls nearest;
  nearest.gap = gap_of(search, a);
  NearestCorners& corners = nearest.corners;
  corners.count = search.simplex.count;
  for (int k = 0; k < corners.count; ++k) {
    corners.weights[k] = search.simplex.weights[k];
    corners.of_a[k] = search.simplex.of_a[k];
    corners.of_b[k] = search.simplex.of_b[k];
  }
  return nearest;
}

BROADSIDE_HD NearestOfHulls exact_hull_gap(const PlacedHull& a, const PlacedHull& b, float rounding_m) {
  HullSearch search = begin_search(a, b, {});
  return exact_hull_gap(a, b, search, rounding_m);
}

}  // namespace broadside::core

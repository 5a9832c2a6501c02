// Between which two numbers the distance of two hulls is, and how deep in each other they are at least; by one lane.
//
// Gilbert, Johnson and Keerthi, A fast procedure for computing the distance between complex objects in
// three-dimensional space (1988): a simplex of the difference of both hulls moves toward the origin. Both numbers hold
// after every step, however well its arithmetic did: the lower one is the gap along a direction, the upper one the
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

struct PlacedHull {
  HullView hull;
  Vec3 center;
  TurnedAxes axes;
};

// Stops where they are apart by more than stop_m, or both numbers are within `thin` of the larger one or slack_m of
// each other. Both are hulls that have ways.
BROADSIDE_HD_CALLED HullGap hull_gap(const PlacedHull& a, const PlacedHull& b, float stop_m, float thin,
                                     float slack_m) {
  constexpr int kMostSteps = 32;
  const HullView& hull_a = a.hull;
  const HullView& hull_b = b.hull;
  // Of B in A's axes.
  const Vec3 between = turned_back(a.axes, b.center - a.center);
  const TurnedAxes turn{turned_back(a.axes, b.axes.x), turned_back(a.axes, b.axes.y), turned_back(a.axes, b.axes.z)};
  HullGap out;
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
    simplex.corners[simplex.count++] = corner;
    float inside_m = 0.0F;
    const Vec3 x = keep_nearest(simplex, inside_m);
    if (inside_m > 0.0F) {
      out.overlap_m = inside_m;
      out.most_m = 0.0F;
      break;
    }
    const float nearer = length(x);
    if (!(nearer < distance)) break;
    distance = nearer;
    out.most_m = nearer;
    if (!(nearer > slack_m)) break;
    n = (1.0F / nearer) * x;
  }
  out.normal = turned(a.axes, best);
  return out;
}

}  // namespace broadside::core

// A box in body axes around a shape, or a ball: it bounds depths and distances cheaply, before they are measured
// exactly.
#pragma once

#include "validation/mechanics/motion.hpp"

namespace broadside::validation {

struct OrientedBox {
  Vec3d center;         // m
  Mat3d r;              // world from body
  Vec3d half;           // m
  double radius = 0.0;  // of a ball, which has no axes; 0 for a box
};

OrientedBox oriented_box(const BodyFacts& facts, Vec3d origin, const Mat3d& r);
inline OrientedBox oriented_box(const BodyFacts& facts, const BodyState& state) {
  return oriented_box(facts, state.origin, state.r);
}

// How far the box reaches from its center along a unit direction, m.
double reach_along(const OrientedBox& box, Vec3d direction);

// An upper bound of the overlap of the shapes inside; where it is negative, they are apart by minus that or more. It is
// the least overlap along the normals of both boxes' faces and along the line of centers.
double overlap_bound(const OrientedBox& a, const OrientedBox& b);

// Distance of a point from the box or ball, m; 0 inside.
double distance_outside(const OrientedBox& box, Vec3d point);

}  // namespace broadside::validation

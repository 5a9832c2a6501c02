// Until when a plane certainly separates two bodies that move and turn: the certified step of conservative advancement.
#pragma once

#include <span>

#include "core/exact/rigid_motion.hpp"

namespace broadside::exact {

// One body: its points at their current positions, and how it moves from here.
struct MovingPoints {
  std::span<const Point> points;  // the body is their hull or any part of the hull
  Point origin;                   // current position
  Point velocity_m;               // of the origin, per step
  Point rotation_rad;             // of the body, per step
  double reach_m = 0.0;           // distance of the farthest point from the origin
};

// now: the time, in units of the step. normal: unit, from B to A. gap_m: the gap that must remain between the hulls
// (for balls around their points, and for rounding). The plane's normal turns at `turn_rad` per step: any rate is
// valid, and that of the touching face is best. Returns the time up to which the hulls stay farther apart than gap_m
// along the normal, 2 for the rest of the step, and `now` when they are not farther apart even now. Uses Taylor's
// formula with the second derivative bounded over the rest of the step.
double parted_until(const MovingPoints& a, const MovingPoints& b, Point normal, Point turn_rad, double gap_m,
                    double now);

// The latest such time over several turning rates: zero, A's, B's, and turn_rad.
double parted_until_by_any(const MovingPoints& a, const MovingPoints& b, Point normal, Point turn_rad, double gap_m,
                           double now);

// The gap between the hulls along the normal; negative when they overlap along it.
double gap_along(const MovingPoints& a, const MovingPoints& b, Point normal);

}  // namespace broadside::exact

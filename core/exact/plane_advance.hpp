// Until when a plane surely parts two bodies that move and turn: the certified step of conservative advancement.
#pragma once

#include <span>

#include "core/exact/rigid_motion.hpp"

namespace broadside::exact {

// One body: its points where they are now, and how it moves from here.
struct MovingPoints {
  std::span<const Point> points;  // the body is their hull, or any part of it
  Point origin;                   // now
  Point velocity_m;               // of the origin, per step
  Point rotation_rad;             // per step
  double reach_m = 0.0;           // the farthest point from the origin
};

// now: time, of the step. normal: unit, from B to A. gap_m: what must stay between the hulls (balls around their
// points, and rounding). The plane's normal turns at `turn_rad` per step: any rate is valid, that of the touching face
// is the best. Returns the time up to which the hulls stay farther apart than gap_m along it, 2 for the rest of the
// step, and `now` when they already are not. Taylor's formula with the second derivative bounded over the rest of the
// step.
double parted_until(const MovingPoints& a, const MovingPoints& b, Point normal, Point turn_rad, double gap_m,
                    double now);

// The same over several turning rates: none, A's, B's, and another one.
double parted_until_by_any(const MovingPoints& a, const MovingPoints& b, Point normal, Point turn_rad, double gap_m,
                           double now);

// Between the hulls along the normal; negative when they overlap along it.
double gap_along(const MovingPoints& a, const MovingPoints& b, Point normal);

}  // namespace broadside::exact

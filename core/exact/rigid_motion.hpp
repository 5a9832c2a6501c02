// A body that moves at constant velocity and turns at a constant rate about its origin, for one step.
#pragma once

#include "core/engine/narrow_phase.hpp"
#include "core/exact/convex_core.hpp"

namespace broadside::exact {

struct RigidMotion {
  core::Pose start;
  Point displacement_m;  // of the origin, over the step
  Point rotation_rad;    // the axis times the angle over the step, world axes
};

// t: 0 to 1.
Placement placement_at(const RigidMotion& motion, double t);

// Bound of the error of a placed point's coordinates: the relative rounding of double that a rotation and a sum
// accumulate (some forty roundings), times the size of their operands. reach_m: the farthest point of the body from its
// origin.
double placing_error_m(const RigidMotion& motion, double reach_m);

}  // namespace broadside::exact

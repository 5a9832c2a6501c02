// stability: a body on a damped spring stays bounded, because the time step is below the limit.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Laws, METHOD 1, for every body with springs; K and C are the sums of its stiffnesses and dampings, w0 = sqrt(K w),
// g = C w, and y its distance from where it would rest, x_r = (sum k a + m gravity) / K:
//   - the scene's dt is below 2 / (sqrt(w0^2 + (g/2)^2) + g/2);
//   - each frame's detection state is the previous end state moved by P(1) to P(3) under gravity and all its springs;
//   - bounded: with D = sqrt(w0^2 |y|^2 + |v|^2), D after t steps without a contact is at most |M^t| D at their start,
//     M the matrix of one step (in these units, spectral norm, the largest of the t steps).
//     A step above the limit has no such bound;
//     then the bound is that of the true motion, D at the start.
//
// Limits. The step: compared as it is; the limit is computed in float64. A frame's velocity: with s springs and
// A = |gravity| + w sum (k |x - a| + c |v|), a chain of 5 + s operations
// (spring_motion.hpp), u (5 + s) dt A, and u |v| for the last addition;
// the position as in state-sanity. Bounded: those roundings, each carried on by at most the largest |M^t|,
// whose own rounding in double is 2^-50 a step.
// The recurrence needs frames that follow each other; the step's law does not.
ValidatorRow stability_row();

}  // namespace broadside::validation

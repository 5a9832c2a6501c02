// state-sanity: every frame is a possible state, and follows from the frame before it.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Laws, per frame, each for the groups that the trace has:
//   - one entry per body, all numbers finite, boxes with min <= max, time = step * dt;
//   - orientations are unit quaternions;
//   - the detection state is the previous end state moved by P(1) to P(3), semi-implicit Euler; static bodies are
//     bit-equal;
//   - the recorded box is the shape's box at the detected position;
//   - contacts name two different bodies (or a face) of which one can move; each starts from the state that the body's
//     previous contact left (colored solver), and the end state is the last one, clipped to v_max; static bodies start
//     each contact where they stand. With solver=jacobi contacts of two bodies start from what was seen, and their
//     changes are added before the faces;
//   - a body whose box ends outside the domain has a contact with that face in the frame (colored solver, jacobi); how
//     many ended deeper than the slop is reported.
//
// Limits. Time: one product in double in the engine and one here, 2 u of double. Quaternions: |q^2 - 1| <= 2 * 5 u, a
// component divided by the length: four products and three sums halved by the root, the root, a quotient, or a
// reciprocal and a product. Integration: u |v| + u |dt g| and u |x| + u |dt v|, one addition and one product each.
// Boxes: one addition, u |bound|. Outside: u |bound|, the addition by which the engine found the body inside. Sums of n
// changes: n + 1 operations on the sum of their sizes, and one addition to the state. All else: 0, copies and
// comparisons.
ValidatorRow state_sanity_row();

}  // namespace broadside::validation

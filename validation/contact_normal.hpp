// contact-normal: each contact's normal and depth are those of the two boxes at the moment it was applied.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, METHOD 4, on the boxes rebuilt from the scene's shapes at the recorded pre positions (float32, as the engine
// stores them), with p_k the overlap on axis k:
//   - the normal has unit length and lies along an axis; for a pair that axis has the least p_k, ties the lowest index;
//   - it points from B to A: the sign of the centers' difference on that axis;
//   - centers nearer than epsilon take +x;
//   - depth is that least p_k (pair) or the overshoot (face), and positive;
//   - a face's normal points inward; contacts are listed by color, faces last; per body, faces come after pairs and in
//   the order -x +x -y +y -z +z; colors rise,
//     and no dynamic body is twice in one color (colored solver).
//
// Limits, float32. Unit length and axis: 0, the components are 0 and 1. Depth: one subtraction, u p_k. Least axis: that
// of two of them, 2 u p_k. Sign: where the centers are closer on the axis than the rounding of their two sums (u |min +
// max| / 2 each; the difference of floats keeps its sign), either sign holds. Epsilon: the same on all axes, 3
// operations on the distance (its subtraction; three products and two sums halved by the root) and one on epsilon
// squared. Boxes themselves are rebuilt bit for bit as the engine must have used them: one float addition a bound.
ValidatorRow contact_normal_row();

}  // namespace broadside::validation

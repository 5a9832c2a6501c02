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
//   - a face's normal points inward; per body, faces come after pairs and in the order -x +x -y +y -z +z; colors rise,
//     and no dynamic body is twice in one color (colored solver).
//
// Limits. Unit length: |n^2 - 1| <= 4 * 2^-24, three components rounded to float and their squares. Depth: one
// subtraction, u p_k. Least axis: two of them. Sign: centers closer on the axis than the rounding of their two sums
// decide nothing, either sign holds. Boxes themselves are compared bit for bit with what the engine must have used.
ValidatorRow contact_normal_row();

}  // namespace broadside::validation

// restitution: how fast a contact separates follows from how fast it approached.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, per application: v_n' = -e_eff v_n for v_n < 0, where e_eff is 0 below v_th and e otherwise, P(17); contacts
// that separate (v_n >= 0) keep their velocities. Where that impulse is below J_min, P(18) lifts it to the smaller of
// J_min and the neutral impulse 2 |v_n| / (wA + wB), and v_n' follows from this one. An impulse above the neutral one,
// where the floor lifts, is left to normal-energy, so that printed-E5 has one name.
//
// Limit, float32: v_n is off by Application::approach_rounding (A), the impulse by 4 more operations (1 + e, product,
// sum of inverse masses, quotient), and both reach v_n' times 1 + e: (1 + e)(A + 4 u |v_n|). The velocities after add
// Application::approach_after_rounding. 0 for a contact that separates: nothing is computed. Where A decides whether a
// contact approaches, on which side of v_th it is, or whether the floor lifts it, either answer holds. J_min itself
// does not round; the neutral impulse does as that of e = 1.
ValidatorRow restitution_row();

}  // namespace broadside::validation

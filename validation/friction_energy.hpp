// friction-energy: friction takes energy out of sliding, stays inside its cone, and is recorded as it acted.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, per application, with v_t the sliding velocity before and t = v_t / |v_t|:
//   - the energy of sliding, |v_t|^2 / (2 (wA + wB)), does not grow;
//   - J_t = -|v_t| / (wA + wB) when that is at most mu_s J_n (stick), else -mu_k J_n (slide), P(20), P(21) with E6;
//   - J_t t is what changed v_t, and the recorded tangent is t;
//   - nothing slides differently after a contact that separates (v_n >= 0).
// J_n is the recorded impulse; normal-energy checks it.
//
// Limits, float32, with S = Application::sliding_rounding of v_t and B = Application::sliding_after_rounding:
//   - energy: t is off by S / |v_t| and 4 operations (three products and two sums halved by the root, the root, a
//     quotient), J_t by 5 on its size, so v_t' differs by at most E = S + 9 u |v_t| + B from a velocity no faster than
//     v_t;
//     |v_t'| E / (wA + wB) as in normal-energy;
//   - stick: S / (wA + wB) and 5 operations (|v_t|'s, the sum of inverse masses, a quotient); slide: 3 on mu_k J_n (mu
//     a product and its root); the choice between them: both, with 3 on the cone. Where that decides, or whether the
//     contact approaches at all, either answer holds;
//   - the change of v_t: B. The tangent: S / (|v_t| - S / 2) and 4 operations, where |v_t| > S; 0 where v_t is zero
//     along a normal that is an axis, and where the contact separates: nothing rounds there.
ValidatorRow friction_energy_row();

}  // namespace broadside::validation

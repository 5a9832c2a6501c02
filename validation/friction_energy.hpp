// friction-energy: friction takes energy out of sliding, inside its cone, and keeps a ledger of it.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, per application, with v_t the sliding velocity before and t = v_t / |v_t|:
//   - the energy of sliding, |v_t|^2 / (2 (wA + wB)), does not grow;
//   - J_t = -|v_t| / (wA + wB) when that is at most mu_s J_n (stick), else -mu_k J_n (slide), P(20), P(21) with E6;
//   - J_t t is what changed v_t, and the recorded tangent is t;
//   - nothing slides differently after a contact that separates (v_n >= 0).
// J_n is the recorded impulse, whose truth is normal-energy's.
//
// Limits: with E the rounding error of v_t' (8 operations relative to the speeds, plus 4 for v_t), energy may round up
// by
// (|v_t'| E + E^2 / 2) / (wA + wB), J_t by E / (wA + wB) and 8 operations on itself, t by E / |v_t|. Where rounding
// decides between stick and slide, or whether the contact approaches, either answer holds.
ValidatorRow friction_energy_row();

}  // namespace broadside::validation

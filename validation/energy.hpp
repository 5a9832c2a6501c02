// energy: the books balance. Every frame's change of energy is the work of its stages.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, per frame that follows the one before: the change of kinetic and potential energy (gravity and springs) is the
// sum of what integration, normal impulses, friction, position correction and the velocity cap did, each predicted from
// what was recorded of it (validation/energy_ledger.hpp). Whether a stage may do such work is the law of others.
//
// Limit: the sum over all stages of how far rounding moves the energy of a body whose state it moves by dx and dv:
// m (|v| dv + dv^2 / 2) + F dx + K dx^2 / 2, F the pull of gravity and springs. dx and dv are those of integration (one
// product and one addition each, 5 more a spring), of an impulse (4 operations and 2 additions) and of a correction (8
// and 1); 2^-44 of each energy for the float64 sums. Clipping rounds nothing.
ValidatorRow energy_row();

}  // namespace broadside::validation

// energy: every frame's change of energy is the sum of the work of its stages.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, per frame that follows the one before: the change of kinetic and potential energy (gravity and springs) is the
// sum of what integration, normal impulses, friction, position correction and the velocity cap did, each predicted from
// what was recorded of it (validation/energy_ledger.hpp). Whether a stage may do such work is judged by other
// validators.
//
// Limit: the sum over all stages of how far rounding moves the energy of a body whose state it moves by dx and dv: m
// (|v| dv + dv^2 / 2) + F dx + K dx^2 / 2, F the pull of gravity and springs. float32: integration, the operations of
// spring_motion.hpp on dt A and one addition, one product and one addition for x; each of the two impulses, 2
// operations (products with w and with the direction) and one addition; a correction, 7 operations (contraction.hpp)
// and one addition. Clipping rounds nothing. The ledger itself is kept in double: 2^-53 of the sum of all magnitudes
// for each of its terms, and for the operations behind one. So the limit of a frame grows with its bodies and contacts;
// one wrong stage of one body in a large scene is found by the other laws.
ValidatorRow energy_row();

}  // namespace broadside::validation

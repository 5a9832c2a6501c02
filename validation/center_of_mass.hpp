// center-of-mass: what happens inside a contact moves neither the common center of mass nor its momentum.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, per application between two dynamic bodies: sum m dx = 0 and sum m dv = 0. A static body or a face of the domain
// can take up any momentum, so for those the law is that they do not move: the recorded state after is bit-equal to
// that before, and a static body is where the scene put it at the end of every frame (when the trace has states).
//
// Limits, float32, per body: the rounding of what is computed for each of the two bodies by itself; the correction, the
// impulses and the sum of inverse masses are the same numbers for both. Position: m times u |x| of the addition, on the
// axes of the normal, and 3 operations on the displacement (quotient of inverse masses, product with the magnitude,
// product with the normal). Velocity: m times u |v| for each of two additions and 3 operations on each impulse's part
// (products with w and with the direction, and one for what the second addition sees of the first). Static: 0, nothing
// is added. Clipping to v_max comes after all contacts and is no part of this.
ValidatorRow center_of_mass_row();

}  // namespace broadside::validation

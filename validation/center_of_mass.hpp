// center-of-mass: what happens inside a contact moves neither the common center of mass nor its momentum.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, per application between two dynamic bodies: sum m dx = 0 and sum m dv = 0. A static body or a face of the domain
// carries any momentum away, so there the law is that it does not move: its recorded state after is bit-equal to that
// before, and a static body is where the scene put it at the end of every frame (when the trace has states).
//
// Limits. Position: m times (u |x| of the addition plus 6 operations on the displacement: quotient of inverse masses,
// their sum, the magnitude's product, the share's product, the product with the normal, and m = 1/w itself). Velocity:
// m times 6 operations (two additions, two products each on both impulses) relative to the speeds. Static: 0, nothing
// is added. Clipping to v_max comes after all contacts and is no part of this.
ValidatorRow center_of_mass_row();

}  // namespace broadside::validation

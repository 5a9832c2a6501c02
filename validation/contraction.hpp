// contraction: each application of the position correction brings a contact towards the slop as METHOD 5 says.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, per application, with d the depth before it, s the relative displacement of A against B along the normal and d'
// = d - s: d' - delta = (1 - alpha beta)(d - delta) for d > delta; nothing moves for d <= delta, and nothing ever moves
// across the normal. The law says nothing about how the two bodies share the displacement: that is center-of-mass.
//
// Limit for d > delta, on each axis that the normal has a part in: the two position additions round to u |x_k| of what
// they end at, and the displacement is a chain of 7 operations (d - delta, beta, alpha, sum of inverse masses,
// quotient, product with the share, product with the normal). 0 on the other axes, and for d <= delta: the engine adds
// zero.
ValidatorRow contraction_row();

}  // namespace broadside::validation

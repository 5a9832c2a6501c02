// restitution: how fast a contact separates follows from how fast it approached.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, per application: v_n' = -e_eff v_n for v_n < 0, where e_eff is 0 below v_th and e otherwise, P(17); contacts
// that separate (v_n >= 0) keep their velocities. Applications whose impulse the floor J_min lifts, P(18), are not
// judged: normal-energy bounds those.
//
// Limit: Application::velocity_after_rounding, 8 operations relative to the speeds. Where rounding of v_n decides
// whether a contact approaches, or on which side of v_th it is, either answer holds.
ValidatorRow restitution_row();

}  // namespace broadside::validation

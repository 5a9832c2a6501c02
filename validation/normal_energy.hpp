// normal-energy: the normal impulse never adds kinetic energy.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, per application: the energy of the relative motion along the normal, v_n^2 / (2 (wA + wB)), does not grow (e <=
// 1 and an impulse floor up to the energy-neutral impulse only, E5). And the recorded impulse is the one that acted:
// J_n = (v_n' - v_n) / (wA + wB), J_n >= 0.
//
// Limits, float32. Energy: no impulse asks for more than e = 1, so v_n' differs from a velocity no faster than v_n by
// at most E = 2 (A + 4 u |v_n|) + B, with A the rounding of v_n, 4 operations of the impulse (restitution.hpp), and B =
// Application::approach_after_rounding; (|v_n'|^2 - (|v_n'| - E)^2) / 2 <= |v_n'| E. Impulse: the velocities follow
// from the recorded J_n with an error of B; 4 u J_n allows for normals whose length is not exactly 1, because of
// rounding. J_n >= 0: a comparison.
ValidatorRow normal_energy_row();

}  // namespace broadside::validation

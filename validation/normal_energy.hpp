// normal-energy: the normal impulse never adds kinetic energy.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Law, per application: the energy of the relative motion along the normal, v_n^2 / (2 (wA + wB)), does not grow (e <=
// 1 and an impulse floor up to the energy-neutral impulse only, E5). And the recorded impulse is the one that acted:
// J_n = (v_n' - v_n) / (wA + wB), J_n >= 0.
//
// Limits: with E the rounding error of v_n' (Application::velocity_after_rounding plus that of v_n), energy may round
// up by (|v_n'| E + E^2 / 2) / (wA + wB), the impulse by E / (wA + wB) and 3 operations on itself.
ValidatorRow normal_energy_row();

}  // namespace broadside::validation

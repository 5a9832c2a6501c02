// ODE's state for the whole process: initialization, the errors that it reported, and the version of the library.
#pragma once

#include <cstdint>
#include <string>

#include "core/engine/equivalence.hpp"

namespace broadside::reference {

// Call it before any other call of ODE on this thread. ODE's errors, which would end the program, are thrown as
// std::runtime_error.
void enter_ode();

// The number of "LCP internal error"s that Dantzig's solver reported on this thread since it was last cleared.
void forget_lcp_errors();
std::uint64_t ode_lcp_errors();

std::string ode_build();  // "ODE 0.16.2 (libode.so.8.0.2), double"
core::EquivalenceCard ode_card();
double ode_erp();  // share of the depth that a step corrects, as ODE ships
double ode_cfm();  // constraint force mixing as ODE ships, s/kg

}  // namespace broadside::reference

// ODE's state of the process: entered once, asked what it said, and which library it is.
#pragma once

#include <cstdint>
#include <string>

#include "core/engine/equivalence.hpp"

namespace broadside::reference {

// Before any other call of ODE on this thread. Its errors, which would end the program, are thrown as
// std::runtime_error.
void enter_ode();

// "LCP internal error"s that Dantzig's solver reported on this thread since they were forgotten.
void forget_lcp_errors();
std::uint64_t ode_lcp_errors();

std::string ode_build();  // "ODE 0.16.2 (libode.so.8.0.2), double"
core::EquivalenceCard ode_card();
double ode_erp();  // share of the depth that a step corrects, as ODE ships
double ode_cfm();  // constraint force mixing as ODE ships, s/kg

}  // namespace broadside::reference

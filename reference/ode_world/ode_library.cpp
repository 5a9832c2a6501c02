#include "reference/ode_world/ode_library.hpp"

#include <ode/ode.h>

#include <atomic>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "reference/loaded_library.hpp"
#include "reference/vendor_build.hpp"

namespace broadside::reference {
namespace {

// The LCP errors that ODE reported since this was cleared. ODE reports through global functions, so a report belongs to
// the thread whose step caused it.
thread_local std::uint64_t lcp_errors = 0;

void hear_message(int, const char* text, va_list) {
  if (std::strstr(text, "LCP internal error") != nullptr) ++lcp_errors;
}

// An exception that ends a step leaves ODE's jobs behind, about which ODE would complain when it is closed.
std::atomic<bool> was_left_early = false;

// After either of these reports ODE would end the program.
[[noreturn]] void hear_error(int, const char* text, va_list arguments) {
  was_left_early = true;
  char line[256];
  std::vsnprintf(line, sizeof line, text, arguments);
  throw std::runtime_error(line);
}

// ODE's state for the whole process: initialized once, closed when the program ends.
struct Library {
  Library() {
    dInitODE2(0);
    dSetMessageHandler(hear_message);
    dSetErrorHandler(hear_error);
    dSetDebugHandler(hear_error);
  }
  ~Library() {
    if (!was_left_early) dCloseODE();
  }
};

// The default of a parameter, read from a new world.
double default_of(dReal (*parameter)(dWorldID)) {
  enter_ode();
  const dWorldID world = dWorldCreate();
  const double value = parameter(world);
  dWorldDestroy(world);
  return value;
}

}  // namespace

void enter_ode() {
  static const Library kLibrary;
  dAllocateODEDataForThread(dAllocateMaskAll);
}

void forget_lcp_errors() {
  lcp_errors = 0;
}

std::uint64_t ode_lcp_errors() {
  return lcp_errors;
}

std::string ode_build() {
  return "ODE " BROADSIDE_ODE_VERSION " (" + loaded_library(reinterpret_cast<const void*>(&dWorldCreate)) + "), " +
         (sizeof(dReal) == sizeof(double) ? "double" : "float");
}

core::EquivalenceCard ode_card() {
  return library_card(ode_build(), reinterpret_cast<const void*>(&dWorldCreate), "float64", "none", 1);
}

double ode_erp() {
  return default_of(dWorldGetERP);
}

double ode_cfm() {
  return default_of(dWorldGetCFM);
}

}  // namespace broadside::reference

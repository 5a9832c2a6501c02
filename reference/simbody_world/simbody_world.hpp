// Simbody's simulation of the scene behind our interface.
#pragma once

#include <memory>
#include <string>

#include "core/engine/dynamics.hpp"
#include "core/engine/equivalence.hpp"

namespace broadside::reference {

struct SimbodyOptions {
  double accuracy = 1e-8;  // of its error-controlled integrator, relative; a step takes as many inner steps as it needs
  double stiffness_pa = 1e7;     // of every surface: rubber
  double slip_speed_m_s = 1e-3;  // below it friction fades: a body that should stick creeps more slowly than this
};

// Records states alone: contact forces are integrated over inner steps and not kept.
std::unique_ptr<core::Dynamics> make_simbody_world(const SimbodyOptions& options);

std::string simbody_build();  // "Simbody 3.7 (libSimTKsimbody.so.3.7), double"
core::EquivalenceCard simbody_card();

}  // namespace broadside::reference

// ODE's simulation of the scene behind our interface.
#pragma once

#include <memory>

#include "core/engine/dynamics.hpp"
#include "reference/vendor_defects.hpp"

namespace broadside::reference {

struct OdeOptions {
  bool is_quick = true;        // dWorldQuickStep, which iterates; otherwise dWorldStep, Dantzig's exact pivoting
  int iterations = 20;         // of QuickStep; 20 is ODE's default
  bool has_gyroscopic = true;  // ODE's default
  // ODE's manual, dWorldSetContactSurfaceLayer: "0.001 can help prevent jittering problems due to contacts being
  // repeatedly made and broken". 0 as ODE ships.
  double surface_layer_m = 0.0;
  bool convex_as_mesh = false;  // convex bodies as their triangles instead of ODE's convex geom
};

// Records states, boxes and points; detection is at the start of the step. `lcp` counts the steps in which Dantzig's
// solver reported an internal error.
std::unique_ptr<core::Dynamics> make_ode_world(const OdeOptions& options, SharedDefectCounter lcp);

}  // namespace broadside::reference

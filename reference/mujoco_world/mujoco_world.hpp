// MuJoCo's simulation of the scene behind our interface.
#pragma once

#include <memory>
#include <string>

#include "core/engine/dynamics.hpp"
#include "core/engine/equivalence.hpp"
#include "reference/vendor_defects.hpp"

namespace broadside::reference {

enum class MujocoIntegrator { kEuler, kImplicit, kRungeKutta };

struct MujocoOptions {
  MujocoIntegrator integrator = MujocoIntegrator::kEuler;
  // MuJoCo's manual on cone: elliptic ones "are a better model of the physical reality"; on impratio: above 1 friction
  // becomes harder than the normal force, "having the general effect of preventing slip", with elliptic cones alone.
  bool has_elliptic_cones = false;
  double friction_impedance = 1.0;
  bool has_many_points = false;  // of two convex bodies; as shipped they have one
  double contact_time_s = 0.02;  // solref's time constant as shipped; a step keeps it at two steps or more
};

// Records states, and points where it can: not with Runge-Kutta, whose four evaluations of the contacts are mixed
// inside the library. Detection is at the start of the step. `boxes` counts the contacts between two boxes, and how
// many of them are too deep.
std::unique_ptr<core::Dynamics> make_mujoco_world(const MujocoOptions& options, SharedDefectCounter boxes);

std::string mujoco_build();  // "MuJoCo 2.2.2 (libmujoco.so.2.2.2), double"
core::EquivalenceCard mujoco_card();

}  // namespace broadside::reference

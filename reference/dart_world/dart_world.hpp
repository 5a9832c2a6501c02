// DART's simulation of the scene behind our interface.
#pragma once

#include <memory>
#include <string>

#include "core/engine/dynamics.hpp"
#include "core/engine/equivalence.hpp"

namespace broadside::reference {

enum class DartDetector {
  kFclMeshes,      // FCL on meshes of the shapes, as DART ships
  kFclPrimitives,  // FCL's own code for primitives; DART's header warns that these are incomplete
  kOwn,            // DART's, for boxes and spheres
};

struct DartOptions {
  DartDetector detector = DartDetector::kFclMeshes;
  bool is_dantzig = true;  // impulses by Dantzig's pivoting, as DART ships; otherwise projected Gauss-Seidel
};

// Records states and points; detection is at the start of the step.
std::unique_ptr<core::Dynamics> make_dart_world(const DartOptions& options);

std::string dart_build();  // "DART 6.12.1 (libdart.so.6.12), double"
core::EquivalenceCard dart_card();
double dart_correction_rate();       // share of the depth that a step corrects, as DART ships
double dart_correction_speed_m_s();  // and at most at this speed

}  // namespace broadside::reference

// How a body's mass is distributed: what a turning body needs beside its mass.
#pragma once

#include <array>
#include <cstdint>

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

// In mesh coordinates: the axes and the origin of the body's mesh.
struct MassProperties {
  std::array<double, 3> center_of_mass_m{};
  // About the center of mass: xx yy zz xy xz yz, kg m^2. The off-diagonal elements are those of the matrix (minus the
  // products of inertia).
  std::array<double, 6> inertia_kg_m2{};

  friend constexpr bool operator==(const MassProperties&, const MassProperties&) = default;
};

// Of a closed mesh of uniform density and this mass (kg). Boxes, spheres and capsules (core/scene/primitive.hpp) by
// their closed forms; other meshes by the divergence theorem over their tetrahedra from the origin (Tonon, Explicit
// exact formulas for the 3-D tetrahedron inertia tensor, 2004). A mesh that is not closed, or whose volume is not above
// zero, is an error.
Result<MassProperties> uniform_mass_properties(const Mesh& mesh, double mass_kg);

// The three principal moments, rising, in kg m^2.
std::array<double, 3> principal_moments(const std::array<double, 6>& inertia_kg_m2);

// Finite, positive, and no principal moment above the sum of the other two; the slack covers numbers that were rounded
// to float32.
Status check_mass_properties(const MassProperties& properties);

}  // namespace broadside::core

// How a body's mass is distributed, which matters where bodies turn.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

// In mesh coordinates: the axes and the origin of the body's mesh.
struct MassProperties {
  std::array<double, 3> center_of_mass_m{};
  // About the center of mass: xx yy zz xy xz yz, kg m^2. The off-diagonal entries are those of the matrix (minus the
  // products of inertia).
  std::array<double, 6> inertia_kg_m2{};

  friend constexpr bool operator==(const MassProperties&, const MassProperties&) = default;
};

// Over which solid a mesh's mass is distributed.
enum class Solid { kPrimitive, kMesh, kHull };

struct UniformSolid {
  MassProperties properties;
  Solid solid = Solid::kMesh;
  std::string why_hull;  // "the mesh is open"; empty unless the hull is used
};

// Mass properties of a body of uniform density and this mass (kg). Boxes, spheres, capsules and cylinders
// (core/scene/primitive.hpp) use their closed forms; other closed meshes use the divergence theorem over the tetrahedra
// between the origin and their triangles (Tonon, Explicit exact formulas for the 3-D tetrahedron inertia tensor, 2004).
// A mesh that is open, crosses itself or encloses no volume above zero uses its convex hull. A flat mesh has no
// inertia: an error.
Result<UniformSolid> uniform_solid(const Mesh& mesh, double mass_kg);
Result<MassProperties> uniform_mass_properties(const Mesh& mesh, double mass_kg);

// The three principal moments, rising, in kg m^2.
std::array<double, 3> principal_moments(const std::array<double, 6>& inertia_kg_m2);

// Requires finite, positive values, and no principal moment above the sum of the other two, with slack for numbers that
// were rounded to float32.
Status check_mass_properties(const MassProperties& properties);

}  // namespace broadside::core

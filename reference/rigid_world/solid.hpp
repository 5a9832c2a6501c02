// The shape that engines of rigid bodies use for a mesh of the scene, decided by the mesh's geometry.
#pragma once

#include <memory>
#include <string>

#include "core/math/vec3.hpp"
#include "core/scene/mesh.hpp"
#include "reference/plain_rigid/linear.hpp"

namespace broadside::reference {

enum class SolidKind { kBox, kSphere, kCapsule, kCylinder, kConvex, kMesh };

struct Solid {
  SolidKind kind = SolidKind::kMesh;
  std::shared_ptr<const core::Mesh> mesh;
  // Sizes of the primitives, which lie around the mesh's origin.
  core::Vec3 half_extents;     // m; of the box around it
  double radius_m = 0.0;       // of all but a box
  double half_length_m = 0.0;  // capsule: of its segment; cylinder: of its axis
  int axis = 0;                // capsule, cylinder: 0 to 2, along x, y or z
  std::string what;            // "box", "convex body", "mesh"
  std::string differs;         // "a mesh with facets up to 1.2 mm inside that surface"; or empty
};

// Turns z to this axis: mesh axes from those of a library whose capsules and cylinders lie along z.
plain::Quaternion turned_from_z(int axis);

Solid solid_of(std::shared_ptr<const core::Mesh> mesh);

}  // namespace broadside::reference

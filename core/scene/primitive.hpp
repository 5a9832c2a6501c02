// Which primitive a triangle mesh represents. Scenes contain only meshes; all engines that know boxes, spheres,
// capsules and cylinders in closed form ask here, so that they all agree on the shape of a mesh.
#pragma once

#include <optional>
#include <string_view>

#include "core/math/vec3.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

enum class PrimitiveKind { kBox, kSphere, kCapsule, kCylinder };

std::string_view primitive_word(PrimitiveKind kind);

// The closed shape on which the mesh's vertices lie, centered at the mesh's origin, in body coordinates.
struct Primitive {
  PrimitiveKind kind = PrimitiveKind::kBox;
  Vec3 half_extents;         // m; of the box around it
  float radius_m = 0.0F;     // of all kinds but a box
  int axis = 0;              // the axis of a capsule or cylinder
  double facet_gap_m = 0.0;  // about the largest distance of the mesh's facets inside the true surface; 0 for a box

  // Of a capsule's segment or of a cylinder.
  [[nodiscard]] float half_length_m() const {
    return kind == PrimitiveKind::kCylinder ? half_extents[axis] : half_extents[axis] - radius_m;
  }
};

// Decided by geometry, never by name: every vertex lies on the shape's surface to within float rounding, the surface is
// closed, and its facets stay within 5 % of the radius. Any other mesh, such as a bunny or an octahedron, is no
// primitive.
std::optional<Primitive> primitive_of(const Mesh& mesh);

// Whether the mesh is closed and no vertex is in front of the plane of any triangle by more than float rounding. Then
// its hull is the body itself.
bool is_convex(const Mesh& mesh);

}  // namespace broadside::core

// Which primitive a triangle mesh is a drawing of. Scenes hold meshes alone; engines that know boxes, spheres,
// capsules and cylinders in closed form ask here, so that every one of them takes a mesh for the same shape or for
// none.
#pragma once

#include <optional>
#include <string_view>

#include "core/math/vec3.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

enum class PrimitiveKind { kBox, kSphere, kCapsule, kCylinder };

std::string_view primitive_word(PrimitiveKind kind);

// Centered at the mesh's origin, in body coordinates. The closed shape that the mesh's vertices lie on.
struct Primitive {
  PrimitiveKind kind = PrimitiveKind::kBox;
  Vec3 half_extents;         // m; of the box around it
  float radius_m = 0.0F;     // of all but a box
  int axis = 0;              // capsule and cylinder: along which axis
  double facet_gap_m = 0.0;  // how far the mesh's facets lie inside the true surface, at most about; 0 for a box

  // Of a capsule's segment, or of a cylinder.
  [[nodiscard]] float half_length_m() const {
    return kind == PrimitiveKind::kCylinder ? half_extents[axis] : half_extents[axis] - radius_m;
  }
};

// Decided by geometry, never by name: every vertex lies on the shape's surface to float rounding, the surface is
// closed, and its facets stay within 5 % of the radius. Anything else, a bunny or an octahedron, is no primitive.
std::optional<Primitive> primitive_of(const Mesh& mesh);

// Closed, and no vertex in front of the plane of any triangle by more than float rounding: its hull is the body itself.
bool is_convex(const Mesh& mesh);

}  // namespace broadside::core

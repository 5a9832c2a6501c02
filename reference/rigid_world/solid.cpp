#include "reference/rigid_world/solid.hpp"

#include <cstdio>
#include <numbers>
#include <utility>

#include "core/scene/primitive.hpp"

namespace broadside::reference {
namespace {

SolidKind kind_of(const core::Primitive& primitive) {
  const std::string_view word = core::primitive_word(primitive.kind);
  if (word == "box") return SolidKind::kBox;
  if (word == "sphere") return SolidKind::kSphere;
  return word == "cylinder" ? SolidKind::kCylinder : SolidKind::kCapsule;
}

}  // namespace

plain::Quaternion turned_from_z(int axis) {
  constexpr double kHalfRoot = 0.5 * std::numbers::sqrt2;
  if (axis == 0) return {kHalfRoot, 0.0, kHalfRoot, 0.0};
  if (axis == 1) return {kHalfRoot, -kHalfRoot, 0.0, 0.0};
  return {};
}

Solid solid_of(std::shared_ptr<const core::Mesh> mesh) {
  Solid s;
  s.mesh = std::move(mesh);
  const auto primitive = core::primitive_of(*s.mesh);
  if (!primitive) {
    s.kind = core::is_convex(*s.mesh) ? SolidKind::kConvex : SolidKind::kMesh;
    s.what = s.kind == SolidKind::kConvex ? "convex body" : "mesh";
    return s;
  }
  s.kind = kind_of(*primitive);
  s.half_extents = primitive->half_extents;
  s.radius_m = primitive->radius_m;
  s.axis = primitive->axis;
  s.what = core::primitive_word(primitive->kind);
  const double along = primitive->half_extents[primitive->axis];
  if (s.kind == SolidKind::kCapsule) s.half_length_m = along - s.radius_m;
  if (s.kind == SolidKind::kCylinder) s.half_length_m = along;
  if (primitive->facet_gap_m > 0.0) {
    char text[80];
    std::snprintf(text, sizeof text, "a mesh with facets up to %.3g mm inside that surface",
                  1e3 * primitive->facet_gap_m);
    s.differs = text;
  }
  return s;
}

}  // namespace broadside::reference

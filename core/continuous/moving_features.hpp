// A vertex and a triangle, or two edges, whose points move along straight lines at constant speed during one step.
#pragma once

#include <cstdint>

#include "core/math/vec3d.hpp"

namespace broadside::continuous {

enum class FeatureKind : std::uint8_t { kVertexFace, kEdgeEdge };

// Points 0 to 3 at the start and at the end of the step: the vertex and the triangle's corners, or the two ends of one
// edge and the two of the other. At time t of the step, 0 to 1, point k is at start[k] + t (end[k] - start[k]).
struct MovingFeatures {
  FeatureKind kind = FeatureKind::kVertexFace;
  core::Vec3d start[4];
  core::Vec3d end[4];
};

}  // namespace broadside::continuous

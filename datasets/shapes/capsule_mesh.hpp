// A capsule: a ball swept along a segment.
#pragma once

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

// Closed, outward-facing, centered at the origin, along z. `radius_m` and `half_length_m` of the segment are > 0. Its
// caps are an octahedron's faces cut into triangle lattices of `frequency` parts (2 to 512) and projected onto the
// ball, so the poles and four points of each rim lie exactly on the axes. V = 4 f^2 + 4 f + 2, T = 8 f^2 + 8 f.
core::Result<core::Mesh> capsule_mesh(double radius_m, double half_length_m, int frequency);

}  // namespace broadside::datasets

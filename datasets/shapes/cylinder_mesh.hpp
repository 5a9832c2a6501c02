// A cylinder with flat ends.
#pragma once

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

// Closed, outward-facing, centered at the origin, along z. `radius_m` and `half_length_m` are > 0. Its ends are regular
// polygons of `sides` corners (a multiple of 4, 12 to 4096), four of them exactly on the axes, so that the mesh's box
// is the cylinder's. V = 2 sides + 2, T = 4 sides.
core::Result<core::Mesh> cylinder_mesh(double radius_m, double half_length_m, int sides);

}  // namespace broadside::datasets

// A box whose faces are cut into a lattice of vertices, so that vertex proximity can detect contacts on its faces.
#pragma once

#include <array>

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

// Closed, outward-facing, centered at the origin. `sides_m` are full lengths, > 0; `segments` cuts per axis, 1 to 1024.
// V = 2 (ab + bc + ca) + 2, T = 4 (ab + bc + ca) for cuts a, b, c.
core::Result<core::Mesh> box_mesh(std::array<double, 3> sides_m, std::array<int, 3> segments);

}  // namespace broadside::datasets

// Random convex polyhedra.
#pragma once

#include <array>
#include <cstdint>

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

// The hull of `corners` (4 to 64) random points on an ellipsoid with these full lengths, all > 0. Closed,
// outward-facing, every corner a vertex: V = corners, T = 2 corners - 4.
core::Result<core::Mesh> convex_mesh(std::array<double, 3> sides_m, int corners, std::uint64_t seed);

}  // namespace broadside::datasets

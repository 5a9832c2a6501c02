// Reduces the number of triangles of a surface. Mesh preparation only: no engine uses this.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

// Is decimation built in? BROADSIDE_CGAL decides at configure time.
bool can_decimate();

// Edge collapse by Garland and Heckbert's plane quadrics (CGAL), until at most `triangles` are left. Collapses that
// turn a triangle by more than a right angle are refused. A triangle soup that is not a manifold is first made one by
// duplicating vertices. Deterministic: the same mesh gives the same bits on x86-64. The result keeps the name and the
// stand-in mark.
// Errors: not built in; the surface cannot be oriented; it cannot be reduced to that many triangles.
core::Result<core::Mesh> decimated(const core::Mesh& mesh, std::uint64_t triangles);

}  // namespace broadside::datasets

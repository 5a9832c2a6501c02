// Fewer triangles for the same surface. Mesh preparation only: no engine uses this.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

// Is decimation built in? BROADSIDE_CGAL chose at configure time.
bool can_decimate();

// Edge collapse by Garland and Heckbert's plane quadrics (CGAL), refusing collapses that turn a triangle by more than a
// right angle, until at most `triangles` are left. A soup that is no manifold becomes one first, by doubling vertices.
// Deterministic: the same mesh gives the same bits on x86-64. The result keeps name and stand-in mark.
// Errors: not built in; the surface cannot be oriented; it cannot be brought down to that many triangles.
core::Result<core::Mesh> decimated(const core::Mesh& mesh, std::uint64_t triangles);

}  // namespace broadside::datasets

// Triangles of a mesh that cross or touch each other where they should not.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

// Number of pairs of triangles that meet beyond the corner or edge that they share, found with exact predicates (CGAL)
// on the vertices as they are. Error: CGAL is not built in (BROADSIDE_CGAL).
core::Result<std::uint64_t> self_intersecting_pairs(const core::Mesh& mesh);

}  // namespace broadside::datasets

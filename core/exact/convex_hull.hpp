// The convex hull of points: its inertia is used in place of an open mesh's.
#pragma once

#include <optional>
#include <vector>

#include "core/scene/mesh.hpp"

namespace broadside::exact {

// The hull is closed with triangles facing outward; its vertices are the given points. Computed in double by Barber,
// Dobkin and Huhdanpaa (The Quickhull Algorithm for Convex Hulls, 1996). Points within 2^-40 of the size of a face
// count as on it. Nothing when all points lie in one plane to that tolerance.
std::optional<core::Mesh> convex_hull(const std::vector<core::Vec3>& points);

}  // namespace broadside::exact

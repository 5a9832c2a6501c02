// The convex hull of points: the body whose inertia stands for that of an open mesh.
#pragma once

#include <optional>
#include <vector>

#include "core/scene/mesh.hpp"

namespace broadside::exact {

// Closed, triangles outward; vertices are the given points, triangles the hull's. By Barber, Dobkin and Huhdanpaa (The
// Quickhull Algorithm for Convex Hulls, 1996), in double. Points within 2^-40 of the size of a face count as on it.
// Nothing when all points lie in one plane to that measure.
std::optional<core::Mesh> convex_hull(const std::vector<core::Vec3>& points);

}  // namespace broadside::exact

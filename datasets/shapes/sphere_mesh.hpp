// Spheres and lumpy bodies: an icosahedron whose faces are cut into triangle lattices and projected outward.
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::datasets {

// Closed, outward-facing, vertices at `radius_m` (> 0) from the origin. Each edge of the icosahedron is cut into
// `frequency` parts, 1 to 1024: V = 10 f^2 + 2, T = 20 f^2.
core::Result<core::Mesh> sphere_mesh(double radius_m, int frequency);

// A closed body of about the given number of triangles (T = 20 f^2 for the nearest f; 20 to 20,971,520), star-shaped
// around the origin and so free of self-intersection: the radius varies smoothly by seeded lumps. Its size is of order
// 1 m: scale it with core::normalized.
core::Result<core::Mesh> lumpy_mesh(std::uint64_t triangles, std::uint64_t seed);

}  // namespace broadside::datasets

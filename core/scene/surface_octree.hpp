// The octree over a body's surface, in body axes and about its center of mass: the nodes of RIGID 8.3. Unlike the
// octree of METHOD 2 it covers the triangles and not only their vertices, so that a corner on a face is found.
#pragma once

#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/method/levels.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

// 1 + up to 8 + up to 64 boxes: cells halve the root box twice. A cell's box bounds the parts of triangles that lie in
// the cell; each triangle adds at most its own box, clipped by the cell. Every point of the surface lies in a box of
// each level, and a box lies inside its parent's. Only for meshes with triangles.
NodeBoxes surface_node_boxes(const Mesh& mesh, Vec3 center_of_mass);

// For a body whose exact test costs no more than tests of its boxes: one node at every level.
NodeBoxes single_node_boxes(const Box& box);

}  // namespace broadside::core

// The octree over a body's surface, in axes of the body and about its center of mass: the nodes of RIGID 8.3. Unlike
// the octree of METHOD 2 it covers the triangles and not their vertices alone, so that a corner on a face is seen.
#pragma once

#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/method/levels.hpp"
#include "core/scene/mesh.hpp"

namespace broadside::core {

// 1 + up to 8 + up to 64 boxes: cells halve the root box twice, and a cell's box is that of the parts of triangles that
// lie in it (of each triangle at most its own box, cut by the cell). Every point of the surface lies in a box of each
// level, and a box lies inside its parent's. Only for meshes with triangles.
NodeBoxes surface_node_boxes(const Mesh& mesh, Vec3 center_of_mass);

// A body whose exact shape costs no more than its boxes: one node at every level.
NodeBoxes single_node_boxes(const Box& box);

}  // namespace broadside::core

// octree-invariants: every octree is complete, and every box and vertex is stored in the right node.
#pragma once

#include "validation/validator.hpp"

namespace broadside::validation {

// Laws, METHOD 2, P-Alg 1 and P-Alg A1.
// Scene octree, in every frame that records it:
//   - node 0 is the root, with the scene's domain as its box; every other node is a child of exactly one;
//   - a node above MAX_LEVEL = 2 has eight children, one level down, and a node at MAX_LEVEL has none: 73 nodes (E7);
//   - children tile their parent: each takes one half of every axis, and halves meet at one plane;
//   - the node of a body contains its box, and none of its children does. Boxes outside the domain are in the root.
// Body octrees, in the frame that records them:
//   - every vertex of every shape is in exactly one leaf, in the cell that halving the root's box twice gives;
//   - a node's box is the tight box of its vertices, empty without any.
//
// Limits. Tiling: 0, the halves share their bounds; the plane is the middle to u |low + high| / 2,
// one addition. Containment:
// a coordinate's cell comes from 4 operations (offset, side, cells per side, product), so a box is in a cell to
// 4 u (offset from the domain's lower face) + 2 u |face|. Cells of vertices: two halvings, 2 u |root|. Tight boxes:
// 0, minima and maxima of floats.
ValidatorRow octree_invariants_row();

}  // namespace broadside::validation

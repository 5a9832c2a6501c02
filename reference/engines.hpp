// The rows of every engine of this folder, for the one table in bench/engines.cpp. Each is defined in the file of its
// name; settings and "what" texts have static storage.
#pragma once

#include "core/engine/engine.hpp"

namespace broadside::reference {

core::EngineRow all_pairs_row();         // broad: exact, the arbiter
core::EngineRow bullet_dbvt_row();       // broad: btDbvtBroadphase
core::EngineRow bullet_dbvt_tree_row();  // broad: btDbvt::collideTT without the broad phase around it
core::EngineRow bullet_sap_row();        // broad: bt32BitAxisSweep3
core::EngineRow bullet_world_row();      // dynamics: btDiscreteDynamicsWorld
core::EngineRow fcl_tree_row();          // broad: fcl::DynamicAABBTreeCollisionManager
core::EngineRow fcl_sap_row();           // broad: fcl::SaPCollisionManager and the other managers
core::EngineRow embree_collide_row();    // broad: rtcCollide
core::EngineRow cgal_boxes_row();        // broad: CGAL::box_self_intersection_d
core::EngineRow hash_cpu_row();          // broad, dynamics: the spatial hash and the pipeline behind it
core::EngineRow ccd_row();               // narrow: libccd on hulls and boxes
core::EngineRow exact_mesh_row();        // narrow: exact, the arbiter
core::EngineRow bullet_box_row();        // narrow: btBoxBoxDetector on axis-aligned boxes
core::EngineRow fcl_box_row();           // narrow: fcl::Box against fcl::Box on axis-aligned boxes
core::EngineRow bullet_shapes_row();     // narrow: btGjkPairDetector with EPA on primitives and convex meshes
core::EngineRow exact_shapes_row();      // narrow: primitives and convex meshes in closed form, the arbiter of these
core::EngineRow fcl_shapes_row();        // narrow: signed distance of primitives and convex meshes
core::EngineRow fcl_mesh_row();          // narrow: fcl::distance and fcl::collide on meshes

}  // namespace broadside::reference

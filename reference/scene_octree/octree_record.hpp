// What a broad phase over a scene octree adds to a trace: the octree's nodes, and the node in which each body is
// stored.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/octree_node.hpp"

namespace broadside::reference {

// Offered, beside core::BroadPhase, by broad phases that have a scene octree.
class OctreeRecord {
 public:
  virtual ~OctreeRecord() = default;
  // Gives the octree of the last update: nodes level by level, siblings next to each other in Morton order;
  // node_of_body by body.
  virtual void tell_octree(std::vector<core::OctreeNode>& nodes, std::vector<std::uint32_t>& node_of_body) const = 0;
};

}  // namespace broadside::reference

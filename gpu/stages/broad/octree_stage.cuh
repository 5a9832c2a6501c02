// The published scene octree, P-Alg 1, as a counting sort of the bodies by node: METHOD section 2. Nodes are in
// preorder, so the bodies of a subtree are one run, and the sound candidates of a body are those that follow it in the
// run of its own node's subtree (P-Alg 2's same node alone is printed-E2). tile_stage.cuh tests them.
#pragma once

#include "core/method/scene_octree.hpp"
#include "gpu/broad/broad_view.hpp"
#include "gpu/stages/grid/team.cuh"

namespace broadside::gpu {

// A node's place in the preorder of the complete octree, and one past the end of its subtree.
struct NodeSpan {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

__device__ inline NodeSpan node_span(const OctreeView& o, const core::Box& box) {
  const core::SceneNode node = core::scene_node(o.grid, box);
  const std::uint32_t morton = node.key >> 4;
  std::uint32_t place = 0;
  for (int level = 1; level <= node.level(); ++level) {
    const std::uint32_t digit = morton >> (3 * (o.grid.depth - level)) & 7U;
    place += 1 + digit * core::complete_octree_nodes(o.grid.depth - level);
  }
  return {place, o.same_node_only ? place + 1 : place + core::complete_octree_nodes(o.grid.depth - node.level())};
}

__device__ inline void octree_count(const OctreeView& o, std::uint64_t body, const core::Box& box) {
  o.rank[body] = atomicAdd(&o.node_count[node_span(o, box).first], 1U);
}

// One warp does this, since nodes are few.
template <typename Team>
__device__ void octree_place_nodes(const Team& team, const OctreeView& o) {
  if (team.rank() >= 32) return;
  const std::uint32_t nodes = core::complete_octree_nodes(o.grid.depth);
  std::uint32_t before = 0;
  for (std::uint32_t first = 0; first < nodes; first += 32) {
    const std::uint32_t node = first + lane();
    const std::uint32_t mine = node < nodes ? o.node_count[node] : 0U;
    std::uint32_t sum = mine;
    for (unsigned step = 1; step < 32; step *= 2) {
      const std::uint32_t other = __shfl_up_sync(kFullWarp, sum, step);
      if (lane() >= step) sum += other;
    }
    if (node < nodes) {
      o.node_begin[node] = before + sum - mine;
      o.node_count[node] = 0;
    }
    before += __shfl_sync(kFullWarp, sum, 31);
  }
  if (lane() == 0) o.node_begin[nodes] = before;
}

template <typename Team>
__device__ void octree_scatter(const Team& team, const OctreeView& o, const PackedBox* boxes, std::uint32_t count) {
  for (std::uint64_t i = team.rank(); i < count; i += team.size()) {
    PackedBox box = boxes[i];
    const NodeSpan span = node_span(o, unpack(box));
    const std::uint32_t place = o.node_begin[span.first] + o.rank[i];
    box.low_tag = static_cast<std::uint32_t>(i);
    o.sorted[place] = box;
    o.range_end[place] = o.node_begin[span.end];
  }
}

}  // namespace broadside::gpu

#include <array>
#include <cstdint>

#include "core/math/box.hpp"
#include "reference/mutants/mutants.hpp"

namespace broadside::reference {
namespace {

using core::Box;
using core::FrameRecord;
using core::Vec3;

std::span<const Mutant> octree_table() {
  static const auto kTable = std::to_array<Mutant>({
      {"stores-one-level-high",
       "bodies are stored in the parent of their node",
       "octree-invariants",
       "errata:E2",
       {.tell =
            [](const World&, FrameRecord& frame) {
              for (std::uint32_t& node : frame.octree_node_of_body)
                if (node != 0) node = frame.octree_nodes[node].parent;
            }}},
      {"stores-by-center",
       "bodies are stored in the lowest cell that contains their center",
       "octree-invariants",
       "errata:E2",
       {.tell =
            [](const World&, FrameRecord& frame) {
              for (std::size_t i = 0; i < frame.octree_node_of_body.size(); ++i) {
                const Vec3 c = core::center(frame.boxes[i]);
                std::uint32_t node = 0;
                while (frame.octree_nodes[node].child_count != 0) {
                  std::uint32_t octant = 0;
                  for (int k = 0; k < 3; ++k)
                    if (c[k] >= core::center(frame.octree_nodes[node].box)[k]) octant |= 1U << static_cast<unsigned>(k);
                  node = frame.octree_nodes[node].first_child + octant;
                }
                frame.octree_node_of_body[i] = node;
              }
            }}},
      {"builds-one-level-less",
       "the octree ends one level early, and bodies a level higher",
       "octree-invariants",
       "errata:E2",
       {.tell =
            [](const World&, FrameRecord& frame) {
              for (std::uint32_t& node : frame.octree_node_of_body)
                if (frame.octree_nodes[node].level == 2) node = frame.octree_nodes[node].parent;
              frame.octree_nodes.resize(9);
              for (core::OctreeNode& n : frame.octree_nodes)
                if (n.level == 1) n.first_child = core::kNoNode, n.child_count = 0;
            }}},
      {"overlapping-children",
       "children are a hundredth too large",
       "octree-invariants",
       "mixed",
       {.tell =
            [](const World&, FrameRecord& frame) {
              for (core::OctreeNode& n : frame.octree_nodes)
                if (n.level == 2)
                  for (int k = 0; k < 3; ++k) n.box.max[k] += 0.01F * (n.box.max[k] - n.box.min[k]);
            }}},
      {"vertex-in-wrong-leaf",
       "vertices above the middle on x stay in the lower octant",
       "octree-invariants",
       "mixed",
       {.tell =
            [](const World&, FrameRecord& frame) {
              for (std::uint32_t& leaf : frame.leaf_of_vertex) leaf &= ~1U;
            }}},
      {"loose-node-boxes",
       "a node's box is larger than its vertices",
       "octree-invariants",
       "mixed",
       {.tell =
            [](const World&, FrameRecord& frame) {
              for (Box& b : frame.body_octree_boxes) b.max.x += 1e-6F;
            }}},
      {"loses-a-vertex",
       "the last vertex has no leaf",
       "octree-invariants",
       "mixed",
       {.tell =
            [](const World&, FrameRecord& frame) {
              if (!frame.leaf_of_vertex.empty()) frame.leaf_of_vertex.pop_back();
            }}},
  });
  return kTable;
}

}  // namespace

std::span<const Mutant> octree_mutants() {
  return octree_table();
}

}  // namespace broadside::reference

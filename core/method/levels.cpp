#include "core/method/levels.hpp"

namespace broadside::core {

NodeBoxes node_boxes(const BodyOctree& tree) {
  NodeBoxes out{};
  out.root = tree.boxes[0];
  for (int node = 0; node < kLevelSize[1]; ++node) {
    const int parent = kLevelOffset[1] + node;
    if (is_empty(tree.boxes[parent])) continue;
    out.leaf_begin[out.level1_count] = out.level2_count;
    out.level1[out.level1_count++] = tree.boxes[parent];
    for (int child = 0; child < 8; ++child) {
      const Box& box = tree.boxes[first_child(parent) + child];
      if (!is_empty(box)) out.level2[out.level2_count++] = box;
    }
  }
  out.leaf_begin[out.level1_count] = out.level2_count;
  return out;
}

}  // namespace broadside::core

#include "core/scene/body_octree.hpp"

namespace broadside::core {
namespace {

struct OctreeCell {
  Vec3 min;
  Vec3 max;
};

// Returns the octant of v in the cell (bit 0 for x, 1 for y, 2 for z), and shrinks the cell to that octant.
int descend(OctreeCell& cell, Vec3 v) {
  int octant = 0;
  for (int k = 0; k < 3; ++k) {
    const float middle = 0.5F * (cell.min[k] + cell.max[k]);
    if (v[k] >= middle) {
      octant |= 1 << k;
      cell.min[k] = middle;
    } else {
      cell.max[k] = middle;
    }
  }
  return octant;
}

}  // namespace

BodyOctree build_body_octree(std::span<const Vec3> vertices) {
  BodyOctree tree;
  tree.boxes.fill(empty_box());
  for (const Vec3 v : vertices) tree.boxes[0] = grown(tree.boxes[0], v);

  std::array<std::uint32_t, 64> counts{};
  tree.leaf_of_vertex.reserve(vertices.size());
  for (const Vec3 v : vertices) {
    OctreeCell cell{tree.boxes[0].min, tree.boxes[0].max};
    const int level1 = descend(cell, v);
    const int leaf = 8 * level1 + descend(cell, v);
    Box& parent = tree.boxes[kLevelOffset[1] + level1];
    Box& box = tree.boxes[kLevelOffset[2] + leaf];
    parent = grown(parent, v);
    box = grown(box, v);
    tree.leaf_of_vertex.push_back(static_cast<std::uint8_t>(leaf));
    ++counts[leaf];
  }

  tree.leaf_begin[0] = 0;
  for (int leaf = 0; leaf < 64; ++leaf) tree.leaf_begin[leaf + 1] = tree.leaf_begin[leaf] + counts[leaf];
  std::array<std::uint32_t, 64> next;
  for (int leaf = 0; leaf < 64; ++leaf) next[leaf] = tree.leaf_begin[leaf];
  tree.sorted_indices.resize(vertices.size());
  tree.sorted_vertices.resize(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const std::uint32_t slot = next[tree.leaf_of_vertex[i]]++;
    tree.sorted_indices[slot] = i;
    tree.sorted_vertices[slot] = vertices[i];
  }
  return tree;
}

}  // namespace broadside::core

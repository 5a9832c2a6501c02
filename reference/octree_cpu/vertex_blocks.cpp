#include "reference/octree_cpu/vertex_blocks.hpp"

#include <algorithm>

namespace broadside::reference {
namespace {

// Small enough that trying all pairs of two blocks costs no more than another level of boxes.
constexpr std::uint32_t kBlock = 8;

struct Entry {
  core::Vec3 at;
  std::uint32_t index;
};

// Halves the node's vertices along its longest side until they are a block.
void split(std::vector<Entry>& entries, std::vector<VertexBlocks::Node>& nodes, std::uint32_t index) {
  const std::uint32_t first = nodes[index].first;
  const std::uint32_t last = nodes[index].last;
  core::Box box = core::empty_box();
  for (std::uint32_t k = first; k < last; ++k) box = core::grown(box, entries[k].at);
  nodes[index].box = box;
  if (last - first <= kBlock) return;
  const core::Vec3 side = box.max - box.min;
  const int axis = side.x >= side.y && side.x >= side.z ? 0 : (side.y >= side.z ? 1 : 2);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(entries.begin() + first, entries.begin() + middle, entries.begin() + last,
                   [axis](const Entry& p, const Entry& q) { return p.at[axis] < q.at[axis]; });
  const auto child = static_cast<std::uint32_t>(nodes.size());
  nodes[index].child = child;
  nodes.push_back({{}, first, middle, 0});
  nodes.push_back({{}, middle, last, 0});
  split(entries, nodes, child);
  split(entries, nodes, child + 1);
}

}  // namespace

VertexBlocks make_vertex_blocks(const core::BodyOctree& tree) {
  std::vector<Entry> entries;
  entries.reserve(tree.sorted_vertices.size());
  for (std::size_t k = 0; k < tree.sorted_vertices.size(); ++k)
    entries.push_back({tree.sorted_vertices[k], tree.sorted_indices[k]});
  VertexBlocks blocks;
  blocks.nodes.reserve(entries.size() / 2 + 64);
  for (std::uint32_t leaf = 0; leaf < 64; ++leaf) {
    if (tree.leaf_begin[leaf] == tree.leaf_begin[leaf + 1]) continue;
    blocks.root[leaf] = static_cast<std::uint32_t>(blocks.nodes.size());
    blocks.nodes.push_back({{}, tree.leaf_begin[leaf], tree.leaf_begin[leaf + 1], 0});
    split(entries, blocks.nodes, blocks.root[leaf]);
  }
  for (const Entry& entry : entries) {
    blocks.vertices.push_back(entry.at);
    blocks.indices.push_back(entry.index);
  }
  return blocks;
}

}  // namespace broadside::reference

#include "gpu/scene/shape_tree.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "core/math/box.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Vec3;

// Sorts `order` so that every aligned run of 2, 4, 8 ... leaves is one box of a kd-tree.
void split(std::span<std::uint32_t> order, std::span<const Vec3> vertices) {
  if (order.size() <= kLeafVertices) return;
  Box box = core::empty_box();
  for (const std::uint32_t k : order) box = core::grown(box, vertices[k]);
  const Vec3 side = box.max - box.min;
  int axis = side.y > side.x ? 1 : 0;
  if (side.z > side[axis]) axis = 2;
  // The lower half has the largest power of two of leaves that is less than all of them.
  std::size_t half = kLeafVertices;
  while (half * 2 < order.size()) half *= 2;
  // Vertices with equal coordinates are ordered by index, so that the order does not depend on the library.
  std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                   [&](std::uint32_t p, std::uint32_t q) {
                     return vertices[p][axis] != vertices[q][axis] ? vertices[p][axis] < vertices[q][axis] : p < q;
                   });
  split(order.first(half), vertices);
  split(order.subspan(half), vertices);
}

Box joined(const Box& a, const Box& b) {
  return core::grown(core::grown(a, b.min), b.max);
}

}  // namespace

void append_tree(ShapeTrees& trees, std::span<const Vec3> vertices, std::span<const std::uint32_t> indices,
                 float mean_edge_m) {
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  split(order, vertices);

  TreeHeader header;
  header.mean_edge_m = mean_edge_m;
  header.vertex_begin = static_cast<std::uint32_t>(trees.vertices.size());
  header.upper_begin = static_cast<std::uint32_t>(trees.upper.size());
  std::vector<Box> level;
  for (const std::uint32_t k : order) {
    if ((trees.vertices.size() - header.vertex_begin) % kLeafVertices == 0) level.push_back(core::empty_box());
    level.back() = core::grown(level.back(), vertices[k]);
    trees.vertices.push_back({vertices[k], std::bit_cast<float>(indices[k])});
  }
  constexpr float kFar = std::numeric_limits<float>::infinity();
  while (trees.vertices.size() % kLeafVertices != 0)
    trees.vertices.push_back({{kFar, kFar, kFar}, std::bit_cast<float>(0xFFFFFFFFU)});

  static_assert(kLeafVertices == kFanOut, "a block is as many vertices as nodes");
  std::uint32_t below = header.vertex_begin / kLeafVertices;
  header.leaf_offset = static_cast<std::uint32_t>(trees.nodes.size()) - below;
  for (std::uint32_t depth = 0;; ++depth) {
    header.top = depth;
    header.root = node_word(depth, below);  // holds if this level is the last
    header.node_begin[depth] = static_cast<std::uint32_t>(trees.nodes.size());
    header.node_count[depth] = static_cast<std::uint32_t>(level.size());
    for (const Box& box : level) trees.nodes.push_back(pack(box, node_word(depth, below++)));
    while (trees.nodes.size() % kFanOut != 0) trees.nodes.push_back(pack(core::empty_box(), node_word(depth, 0)));
    const auto nodes = std::span(trees.nodes).subspan(header.node_begin[depth], level.size());
    if (header.upper_count == 0 && (level.size() <= 1 || (depth > 0 && level.size() <= kMostUpperNodes))) {
      header.upper_level = depth;
      header.upper_count = header.node_count[depth];
      trees.upper.insert(trees.upper.end(), nodes.begin(), nodes.end());
    }
    if (level.size() <= 1) {
      trees.upper.insert(trees.upper.end(), nodes.begin(), nodes.end());
      break;
    }
    below = header.node_begin[depth] / kFanOut;
    std::vector<Box> parents((level.size() + kFanOut - 1) / kFanOut, core::empty_box());
    for (std::size_t n = 0; n < level.size(); ++n) parents[n / kFanOut] = joined(parents[n / kFanOut], level[n]);
    level = std::move(parents);
  }
  trees.headers.push_back(header);
}

}  // namespace broadside::gpu

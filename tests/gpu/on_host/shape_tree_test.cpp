// The vertex trees that the GPU's proximity stage descends: every vertex in one leaf, every box tight.
#include "gpu/scene/shape_tree.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

namespace broadside::gpu {
namespace {

using core::Vec3;

std::vector<Vec3> spiral(std::uint32_t count) {
  std::vector<Vec3> vertices;
  for (std::uint32_t k = 0; k < count; ++k) {
    const float t = 0.1F * static_cast<float>(k);
    vertices.push_back({std::cos(t), 0.01F * t, std::sin(t)});
  }
  return vertices;
}

ShapeTrees tree_of(const std::vector<Vec3>& vertices) {
  std::vector<std::uint32_t> indices(vertices.size());
  std::iota(indices.begin(), indices.end(), 0U);
  ShapeTrees trees;
  append_tree(trees, vertices, indices, 0.5F);
  return trees;
}

TEST(ShapeTree, HoldsEveryVertexOnce) {
  for (const std::uint32_t count : {1U, 15U, 16U, 17U, 128U, 129U, 1000U, 2503U}) {
    const std::vector<Vec3> vertices = spiral(count);
    const ShapeTrees trees = tree_of(vertices);
    std::set<std::uint32_t> seen;
    for (const PackedVec3& v : trees.vertices) {
      const auto index = std::bit_cast<std::uint32_t>(v.w);
      if (index == 0xFFFFFFFFU) {
        EXPECT_TRUE(std::isinf(v.v.x));
        continue;
      }
      EXPECT_EQ(v.v, vertices[index]);
      seen.insert(index);
    }
    EXPECT_EQ(seen.size(), count);
    EXPECT_EQ(trees.vertices.size() % kLeafVertices, 0U);
    EXPECT_LT(trees.vertices.size(), count + kLeafVertices);
  }
}

TEST(ShapeTree, BoxesAreTheBoundsOfTheirLeaves) {
  const ShapeTrees trees = tree_of(spiral(2503));
  const TreeHeader& header = trees.headers[0];
  ASSERT_EQ(header.node_count[header.top], 1U);
  std::uint32_t leaves_below = 1;
  for (std::uint32_t level = 0; level <= header.top; ++level, leaves_below *= kFanOut) {
    for (std::uint32_t n = 0; n < header.node_count[level]; ++n) {
      core::Box expected = core::empty_box();
      for (std::uint32_t k = n * leaves_below * kLeafVertices; k < (n + 1) * leaves_below * kLeafVertices; ++k) {
        if (k < trees.vertices.size() && !std::isinf(trees.vertices[k].v.x))
          expected = core::grown(expected, trees.vertices[k].v);
      }
      EXPECT_EQ(unpack(trees.nodes[header.node_begin[level] + n]), expected) << "level " << level << " node " << n;
    }
  }
}

// Of a shape behind another one.
TEST(ShapeTree, EveryNodeNamesTheBlockOfItsChildren) {
  ShapeTrees trees = tree_of(spiral(100));
  const std::vector<Vec3> vertices = spiral(2503);
  const std::vector<std::uint32_t> indices(vertices.size(), 7);
  append_tree(trees, vertices, indices, 1.0F);
  const TreeHeader& header = trees.headers[1];
  for (std::uint32_t level = 0; level <= header.top; ++level) {
    EXPECT_EQ(header.node_begin[level] % kFanOut, 0U);
    for (std::uint32_t n = 0; n < (header.node_count[level] + kFanOut - 1) / kFanOut * kFanOut; ++n) {
      const PackedBox& node = trees.nodes[header.node_begin[level] + n];
      EXPECT_EQ(level_of(node.low_tag), level);
      EXPECT_EQ(core::is_empty(unpack(node)), n >= header.node_count[level]);
      if (n >= header.node_count[level]) continue;
      const std::uint32_t first = level == 0 ? header.vertex_begin : header.node_begin[level - 1];
      EXPECT_EQ(block_of(node.low_tag) * kFanOut, first + n * kFanOut) << "level " << level << " node " << n;
      if (level > 0) continue;
      EXPECT_EQ(node.low_tag + header.leaf_offset, header.node_begin[0] + n);
    }
  }
  EXPECT_EQ(header.root, trees.nodes[header.node_begin[header.top]].low_tag);
}

// For a single leaf, for a leaf's parent, and for the lowest level with so few nodes.
TEST(ShapeTree, NamesTheUpperNodesAndTheRootBehindThem) {
  const struct {
    std::uint32_t vertices;
    std::uint32_t level;
    std::uint32_t count;
  } kCases[] = {{5, 0, 1}, {9, 1, 1}, {1000, 1, 16}, {8192, 1, 128}, {8193, 2, 17}, {70000, 3, 18}};
  for (const auto& expected : kCases) {
    const ShapeTrees trees = tree_of(spiral(expected.vertices));
    const TreeHeader& header = trees.headers[0];
    EXPECT_EQ(header.upper_level, expected.level) << expected.vertices;
    ASSERT_EQ(header.upper_count, expected.count) << expected.vertices;
    ASSERT_EQ(trees.upper.size(), header.upper_count + 1U);
    for (std::uint32_t k = 0; k < header.upper_count; ++k)
      EXPECT_EQ(unpack(trees.upper[k]), unpack(trees.nodes[header.node_begin[header.upper_level] + k])) << k;
    EXPECT_EQ(unpack(trees.upper.back()), unpack(trees.nodes[header.node_begin[header.top]]));
    EXPECT_EQ(trees.upper.back().low_tag, header.root);
  }
}

TEST(ShapeTree, OfNoVerticesIsEmpty) {
  const ShapeTrees trees = tree_of({});
  EXPECT_TRUE(trees.nodes.empty());
  EXPECT_TRUE(trees.upper.empty());
  EXPECT_EQ(trees.headers[0].upper_count, 0U);
}

TEST(ShapeTree, KeepsShapesApart) {
  const std::vector<Vec3> first = spiral(100);
  const std::vector<Vec3> second = spiral(40);
  const std::vector<std::uint32_t> indices(100, 7);
  ShapeTrees trees;
  append_tree(trees, first, indices, 1.0F);
  append_tree(trees, second, std::span(indices).first(40), 2.0F);
  ASSERT_EQ(trees.headers.size(), 2U);
  EXPECT_EQ(trees.headers[1].vertex_begin, 104U);  // 100 filled up to whole leaves of 8
  EXPECT_EQ(trees.headers[1].node_begin[0], trees.headers[0].node_begin[trees.headers[0].top] + kFanOut);
  EXPECT_EQ(trees.headers[1].upper_begin, trees.headers[0].upper_count + 1);
  EXPECT_EQ(trees.headers[1].mean_edge_m, 2.0F);
}

}  // namespace
}  // namespace broadside::gpu

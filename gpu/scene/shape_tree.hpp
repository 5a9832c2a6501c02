// A tree of tight boxes over one shape's vertices. It is built once on the host; the proximity stage descends it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/vec3.hpp"
#include "gpu/scene/packed_box.hpp"

namespace broadside::gpu {

// Testing 8 children against 8 takes a warp 64 tests, 2 a lane; testing 8 vertices against 8 takes a group of 8 lanes
// 64, 8 a lane.
constexpr std::uint32_t kLeafVertices = 8;
constexpr std::uint32_t kFanOut = 8;
// Enough for 8 * 8^9 vertices, which take 17 GB. The 28 bits that name a block of eight suffice for twice as many.
constexpr std::uint32_t kMaxTreeLevels = 10;

// The most node pairs that wait while two trees of this many levels are descended together: opening a pair of nodes
// adds at most 63 pairs, all of a lower level than the higher of the two.
constexpr std::uint32_t stack_entries_of(std::uint32_t levels) {
  return 64 * levels;
}

// The word that is stored with a node's box: the node's level, and which block of eight holds its children, in `nodes`
// or, for a leaf, in `vertices`. So a thread that has loaded a box knows where the children are.
BROADSIDE_HD constexpr std::uint32_t node_word(std::uint32_t level, std::uint32_t block) {
  return level << 28 | block;
}
BROADSIDE_HD constexpr std::uint32_t level_of(std::uint32_t word) {
  return word >> 28;
}
BROADSIDE_HD constexpr std::uint32_t block_of(std::uint32_t word) {
  return word & 0xFFFFFFFU;
}

// A search of two trees by several warps begins on the lowest level that has at most this many nodes; that is a level
// above the leaves, unless the root is a leaf. From each tree it takes the nodes that are near the other's root, and
// tries all pairs of them.
constexpr std::uint32_t kMostUpperNodes = 128;

// Where one shape's tree lies in the arrays shared by all shapes. Level 0 holds the leaves; level `top` is the root,
// one node. Children of node n are 8 n .. 8 n + 7 of the level below, leaf n holds vertices 8 n .. 8 n + 7. Every level
// is filled up with empty boxes, and the last leaf with vertices at infinity; neither is near anything.
struct TreeHeader {
  std::uint32_t top = 0;
  std::uint32_t root = 0;         // its word
  std::uint32_t leaf_offset = 0;  // from the block that a leaf's word names to the leaf's own place among `nodes`
  std::uint32_t node_begin[kMaxTreeLevels] = {};
  std::uint32_t node_count[kMaxTreeLevels] = {};
  std::uint32_t vertex_begin = 0;
  std::uint32_t upper_level = 0;
  std::uint32_t upper_count = 0;
  std::uint32_t upper_begin = 0;  // where these nodes begin in `upper`; the root follows them
  float mean_edge_m = 0.0F;
};

struct ShapeTrees {
  std::vector<TreeHeader> headers;   // one per shape
  std::vector<PackedBox> nodes;      // body coordinates; the low tag is the node's word
  std::vector<PackedBox> upper;      // likewise: for each shape its upper nodes, then its root
  std::vector<PackedVec3> vertices;  // body coordinates; w holds the bits of the index in the mesh
};

// Appends the tree of one shape; indices[k] is the mesh's index of vertices[k]. Vertices are split at the median of the
// longest side, again and again, into runs of whole leaves: on a bunny the search opens a quarter of the leaf pairs
// that it opens when vertices are ordered along a Morton curve (65 against 281 of 16 vertices, in a dense heap).
void append_tree(ShapeTrees& trees, std::span<const core::Vec3> vertices, std::span<const std::uint32_t> indices,
                 float mean_edge_m);

}  // namespace broadside::gpu

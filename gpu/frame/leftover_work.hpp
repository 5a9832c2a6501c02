// Leftover work: the rest of a long search for a pair's nearest vertices, which a team of warps leaves to the whole
// grid.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "gpu/frame/placed_shape.hpp"
#include "gpu/scene/shape_tree.hpp"

namespace broadside::gpu {

// A node of each body's tree, by its word (shape_tree.hpp), and the squared gap of their boxes.
struct NodePair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  float gap2 = 0.0F;

  BROADSIDE_HD bool are_leaves() const { return level_of(a | b) == 0; }
};

struct LeftoverSearch {
  PlacedPair bodies;
  std::uint32_t k = 0;      // the pair's place among the pairs that are measured
  float bound_m2 = 0.0F;    // the smallest squared distance so far
  std::uint32_t nodes = 0;  // how many entries are pairs of nodes; pairs of leaves follow them
  std::uint32_t leaves = 0;
};
static_assert(sizeof(LeftoverSearch) == 48, "read in words of 16 bytes");

// Room for the leftovers of one turn. There are two: while the grid works on one, it writes new leftovers to the other.
struct LeftoverView {
  static constexpr std::uint32_t kMost = 128;
  static constexpr std::uint32_t kEntries = 256;  // of each

  LeftoverSearch* items = nullptr;  // [kMost]
  NodePair* entries = nullptr;      // [kMost * kEntries]
};

}  // namespace broadside::gpu

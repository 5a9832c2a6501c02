// What is left of a long search for a pair's nearest vertices, when a team of warps hands it over to the whole grid.
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

struct SearchRest {
  PlacedPair bodies;
  std::uint32_t k = 0;      // the pair's place among those that are measured
  float bound_m2 = 0.0F;    // the smallest squared distance so far
  std::uint32_t nodes = 0;  // of so many entries; then come those of leaves
  std::uint32_t leaves = 0;
};
static_assert(sizeof(SearchRest) == 48, "read in words of 16 bytes");

// Of one time that the grid shares. What it hands over again goes to the other of two.
struct RestsView {
  static constexpr std::uint32_t kMost = 128;
  // Of so few pairs each has a place of its own.
  static constexpr std::uint32_t kMostMarked = 64;
  static constexpr std::uint32_t kEntries = 256;  // of each

  SearchRest* items = nullptr;  // [kMost]
  NodePair* entries = nullptr;  // [kMost * kEntries]
};

}  // namespace broadside::gpu

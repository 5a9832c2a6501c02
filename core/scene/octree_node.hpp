// A cell of the scene octree as it is recorded in a trace: P-Alg 1's arrays, METHOD section 2.
#pragma once

#include <cstdint>

#include "core/math/box.hpp"

namespace broadside::core {

// Stands for no parent or no child.
constexpr std::uint32_t kNoNode = 0xFFFFFFFFU;

// Nodes are numbered level by level, siblings next to each other; 0 is the root.
struct OctreeNode {
  Box box;
  std::uint32_t level = 0;
  std::uint32_t parent = kNoNode;
  std::uint32_t first_child = kNoNode;
  std::uint32_t child_count = 0;

  friend constexpr bool operator==(const OctreeNode&, const OctreeNode&) = default;
};

}  // namespace broadside::core

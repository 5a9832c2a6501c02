// The scene octree, P-Alg 1 and METHOD section 2: in which node of a complete octree over the domain a body is stored.
//
// Bodies are ordered by node in preorder (a node before its descendants, siblings in Morton order), so that the bodies
// of a node's whole subtree are one contiguous range. The sound candidates of a body are in its own node and the node's
// descendants: they follow the body, up to the end of its node's subtree. Candidates in ancestors are found from the
// other body of the pair.
#pragma once

#include <cstdint>

#include "core/attributes.hpp"
#include "core/math/box.hpp"
#include "core/math/vec3.hpp"
#include "core/method/space_curve.hpp"

namespace broadside::core {

// A node key has 27 bits of Morton code (9 levels of 3) above 4 bits for the level.
inline constexpr int kMaxSceneOctreeDepth = 9;
// P-Alg 1's MAX_LEVEL: 1 + 8 + 64 = 73 nodes.
inline constexpr int kSceneOctreeDepth = 2;

// Nodes of a complete octree of this depth: 1, 9, 73 ...
BROADSIDE_HD constexpr std::uint32_t complete_octree_nodes(int depth) {
  return ((1U << (3U * (static_cast<std::uint32_t>(depth) + 1U))) - 1U) / 7U;
}

// A node of the octree: its preorder key, and one past the largest key in its subtree.
struct SceneNode {
  std::uint32_t key = 0;
  std::uint32_t subtree_end = 0;

  // 0 = the root.
  [[nodiscard]] BROADSIDE_HD int level() const { return static_cast<int>(key & 15U); }
  friend constexpr bool operator==(const SceneNode&, const SceneNode&) = default;
};

// The finest cells of the complete octree: 2^depth on each side. Any monotone map from coordinates to cells makes the
// octree exact, so rounding here is harmless: a region that two boxes share is inside both their nodes.
struct SceneGrid {
  Box domain;
  Vec3 cells_per_m;
  int depth = kSceneOctreeDepth;
};

BROADSIDE_HD SceneGrid make_scene_grid(const Box& domain, int depth) {
  const auto cells = static_cast<float>(1U << static_cast<unsigned>(depth));
  SceneGrid grid{domain, {}, depth};
  for (int axis = 0; axis < 3; ++axis) {
    const float side_m = domain.max[axis] - domain.min[axis];
    grid.cells_per_m[axis] = side_m > 0.0F ? cells / side_m : 0.0F;
  }
  return grid;
}

// Cells are half-open, [lower face, upper face). P-Alg 1's containment test implies closed cells; with these, two boxes
// that touch exactly on a cell face would be stored in nodes of different branches and never be compared, though
// touching counts, P(6).
BROADSIDE_HD std::uint32_t scene_cell(const SceneGrid& grid, int axis, float coordinate_m) {
  const float cell = (coordinate_m - grid.domain.min[axis]) * grid.cells_per_m[axis];
  const auto last = static_cast<float>((1U << static_cast<unsigned>(grid.depth)) - 1U);
  if (!(cell > 0.0F)) return 0;
  return static_cast<std::uint32_t>(cell < last ? cell : last);
}

// The lowest node that completely contains the box. The root when the box is not inside the domain.
BROADSIDE_HD SceneNode scene_node(const SceneGrid& grid, const Box& box) {
  const auto depth = static_cast<std::uint32_t>(grid.depth);
  std::uint32_t low[3];
  std::uint32_t differing = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (box.min[axis] < grid.domain.min[axis] || box.max[axis] > grid.domain.max[axis])
      return {0, 1U << (3U * depth + 4U)};
    low[axis] = scene_cell(grid, axis, box.min[axis]);
    differing |= low[axis] ^ scene_cell(grid, axis, box.max[axis]);
  }
  // Goes up one level for each bit in which the two corners differ.
  std::uint32_t up = 0;
  while ((differing >> up) != 0U) ++up;
  const std::uint32_t first = morton_code(low[0], low[1], low[2]) >> (3U * up) << (3U * up);
  return {first << 4U | (depth - up), (first + (1U << (3U * up))) << 4U};
}

}  // namespace broadside::core

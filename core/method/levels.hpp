// Which boxes of the body octrees are tested, pair by pair: the levels of P-Tables 5 and 6, METHOD section 2.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/attributes.hpp"
#include "core/math/box.hpp"
#include "core/scene/body_octree.hpp"

namespace broadside::core {

enum class Levels : int { kFlat, kLevel1, kA, kB, kC };

struct LevelsRow {
  std::string_view name;
  Levels levels;
};

inline constexpr std::array<LevelsRow, 5> kLevels{
    {{"flat", Levels::kFlat}, {"level1", Levels::kLevel1}, {"A", Levels::kA}, {"B", Levels::kB}, {"C", Levels::kC}}};

constexpr std::optional<Levels> levels_named(std::string_view name) {
  for (const LevelsRow& row : kLevels)
    if (row.name == name) return row.levels;
  return std::nullopt;
}

// The boxes of one body octree without its empty nodes, in node order, in body coordinates. Level-2 boxes of level-1
// box k are leaf_begin[k] .. leaf_begin[k + 1].
struct NodeBoxes {
  Box root;
  Box level1[8];
  Box level2[64];
  std::uint8_t leaf_begin[9];
  std::uint8_t level1_count;
  std::uint8_t level2_count;
};

// Whether two boxes overlap at given positions. Each bound is rounded once, so a node's world box has the same numbers
// everywhere.
BROADSIDE_HD bool overlaps_at(const Box& a, Vec3 xa, const Box& b, Vec3 xb) {
  return overlaps(translated(a, xa), translated(b, xb));
}

// Replaces `tests` below when nothing is counted: it does nothing and costs nothing.
struct Uncounted {
  BROADSIDE_HD Uncounted& operator++() { return *this; }
};

// Each function counts its box tests by ++tests. They stop at the first overlap, so the count is part of the result.
template <typename Tests>
BROADSIDE_HD bool level1_overlaps(const NodeBoxes& a, Vec3 xa, const NodeBoxes& b, Vec3 xb, Tests& tests) {
  for (int p = 0; p < a.level1_count; ++p) {
    for (int q = 0; q < b.level1_count; ++q) {
      ++tests;
      if (overlaps_at(a.level1[p], xa, b.level1[q], xb)) return true;
    }
  }
  return false;
}

// All pairs of level-2 boxes.
template <typename Tests>
BROADSIDE_HD bool level2_overlaps(const NodeBoxes& a, Vec3 xa, const NodeBoxes& b, Vec3 xb, Tests& tests) {
  for (int p = 0; p < a.level2_count; ++p) {
    for (int q = 0; q < b.level2_count; ++q) {
      ++tests;
      if (overlaps_at(a.level2[p], xa, b.level2[q], xb)) return true;
    }
  }
  return false;
}

// Level 1 against level 1; where two overlap, their level-2 children.
template <typename Tests>
BROADSIDE_HD bool descent_overlaps(const NodeBoxes& a, Vec3 xa, const NodeBoxes& b, Vec3 xb, Tests& tests) {
  for (int p = 0; p < a.level1_count; ++p) {
    for (int q = 0; q < b.level1_count; ++q) {
      ++tests;
      if (!overlaps_at(a.level1[p], xa, b.level1[q], xb)) continue;
      for (int r = a.leaf_begin[p]; r < a.leaf_begin[p + 1]; ++r) {
        for (int s = b.leaf_begin[q]; s < b.leaf_begin[q + 1]; ++s) {
          ++tests;
          if (overlaps_at(a.level2[r], xa, b.level2[s], xb)) return true;
        }
      }
    }
  }
  return false;
}

// True when boxes of the last level in this setting overlap somewhere. A child box lies inside its parent's box, also
// after rounding, so A, B and C always agree.
template <typename Tests>
BROADSIDE_HD bool is_confirmed(Levels levels, const NodeBoxes& a, Vec3 xa, const NodeBoxes& b, Vec3 xb, Tests& tests) {
  switch (levels) {
    case Levels::kFlat:
      ++tests;
      return overlaps_at(a.root, xa, b.root, xb);
    case Levels::kLevel1:
      return level1_overlaps(a, xa, b, xb, tests);
    case Levels::kA:
      return level2_overlaps(a, xa, b, xb, tests);
    case Levels::kB:
      return descent_overlaps(a, xa, b, xb, tests);
    case Levels::kC:
      ++tests;
      return overlaps_at(a.root, xa, b.root, xb) && descent_overlaps(a, xa, b, xb, tests);
  }
  return false;
}

BROADSIDE_HD bool is_confirmed(Levels levels, const NodeBoxes& a, Vec3 xa, const NodeBoxes& b, Vec3 xb) {
  Uncounted tests;
  return is_confirmed(levels, a, xa, b, xb, tests);
}

NodeBoxes node_boxes(const BodyOctree& tree);

}  // namespace broadside::core

// Figures that characterize a set of boxes and explain why a search is fast or slow on it: how unequal, how thin and
// how clustered the boxes are.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/math/box.hpp"

namespace broadside::datasets {

struct BoxKind {
  std::uint64_t boxes = 0;
  // Shortest, median and longest of the boxes' longest sides, m.
  double least_m = 0.0;
  double median_m = 0.0;
  double most_m = 0.0;
  // Share of boxes that are more than 16 times longer than thick.
  double thin_share = 0.0;
  // The median ratio of the shortest to the longest side: 1 for cubes, 0 for boxes in a plane or on a line.
  double flatness = 0.0;
  // The smallest share of the world's cells that holds half of the boxes, with cells that hold 8 on average: some 0.4
  // where boxes are spread evenly, 0.001 where they lie in heaps far apart.
  double cells_of_half = 0.0;

  // Largest over smallest; infinite where some boxes are points and some are not.
  [[nodiscard]] double size_ratio() const;
};

// Computed from at most 100,000 of the boxes, spread evenly over their numbers. All boxes are finite, min <= max.
BoxKind kind_of(std::span<const core::Box> boxes);

// "100000 boxes; longest sides 0.51 to 1.5 m, ...", followed by the number of pairs that an engine found.
std::string words_of(const BoxKind& kind, double pairs_a_box);

}  // namespace broadside::datasets

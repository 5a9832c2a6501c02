// What kind of set some boxes are, in figures that tell why a search is fast or slow on them: how unequal, how thin,
// how clustered.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/math/box.hpp"

namespace broadside::datasets {

struct BoxKind {
  std::uint64_t boxes = 0;
  // Longest sides, m.
  double least_m = 0.0;
  double median_m = 0.0;
  double most_m = 0.0;
  // Boxes that are more than 16 times longer than thick.
  double thin_share = 0.0;
  // Of the shortest side to the longest, the median: 1 for cubes, 0 for what lies in a plane or on a line.
  double flatness = 0.0;
  // The least share of the world's cells that holds half of the boxes, where a cell holds 8 on average: some 0.4 where
  // boxes are spread evenly, 0.001 where they lie in heaps far apart.
  double cells_of_half = 0.0;

  // Most over least; infinite where some boxes are points and some are not.
  [[nodiscard]] double size_ratio() const;
};

// Of at most 100,000 of them, evenly by number. All are finite, min <= max.
BoxKind kind_of(std::span<const core::Box> boxes);

// "100000 boxes; longest sides 0.51 to 1.5 m, ..."; with the pairs that an engine found.
std::string words_of(const BoxKind& kind, double pairs_a_box);

}  // namespace broadside::datasets

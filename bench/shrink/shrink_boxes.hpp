// Makes a set of boxes in which a broad phase is wrong as small as it can be.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/shrink/shrink_scene.hpp"
#include "core/math/box.hpp"
#include "core/pair.hpp"
#include "core/result.hpp"

namespace broadside::bench {

// Pairs that a broad phase finds among boxes, none of them static.
using PairFinder = std::function<core::Result<std::vector<core::Pair>>(const std::vector<core::Box>&)>;

struct ShrunkBoxes {
  std::vector<core::Box> boxes;
  std::vector<core::Pair> missed;  // overlapping pairs that it does not find in them
  std::vector<core::Pair> extra;   // pairs that it finds and that do not overlap
  std::uint64_t trials = 0;
  double seconds = 0.0;
  bool is_out_of_time = false;
};

// Removes boxes, then shifts all so that the first is at the origin, then removes digits, as long as the finder's pairs
// are not the set of overlapping pairs (found by comparing all pairs of few boxes, and by the validators' join for
// many). A finder that fails with an error counts as wrong too, if it failed so on the whole set; then missed and extra
// are empty. Errors: the finder is right about the whole set.
core::Result<ShrunkBoxes> shrink_boxes(const std::vector<core::Box>& boxes, const PairFinder& find,
                                       const ShrinkLimits& limits);

}  // namespace broadside::bench

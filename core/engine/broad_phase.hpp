// Boxes in, overlapping pairs out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/engine/counter.hpp"
#include "core/math/box.hpp"
#include "core/pair.hpp"
#include "core/result.hpp"

namespace broadside::core {

struct BroadPhaseTraits {
  bool exact = true;               // returns exactly the overlapping pairs of the boxes it was given
  double margin_m = 0.0;           // by which it enlarges boxes internally; filtered before read_back
  bool keeps_stale_pairs = false;  // its raw pairs may no longer overlap; filtered before read_back
};

struct PairSet {
  std::vector<Pair> pairs;     // sorted, i < j, no duplicates, no pair of two static bodies
  std::uint64_t demanded = 0;  // pairs that the engine found; more than pairs.size() means that some are missing
  std::uint64_t raw = 0;       // pairs that the engine reported before they were filtered on the given boxes
  double filter_s = 0.0;       // time of that filter: reported separately, beside update and find
};

// Call order: load, then (update, find, read_back) per frame; find may follow load at once.
class BroadPhase {
 public:
  virtual ~BroadPhase() = default;

  [[nodiscard]] virtual BroadPhaseTraits traits() const = 0;
  // Not timed, and finds no pairs. is_static[i] != 0 marks body i; two static bodies are no pair. Both have one entry
  // per body.
  virtual Status load(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) = 0;
  // Timed. The same number of boxes as were loaded, in the same order. All finite, min <= max.
  virtual Status update(std::span<const Box> boxes) = 0;
  // Timed. Returns when the pairs exist, on the device for a GPU engine.
  virtual Status find() = 0;
  // Has its own timing zone: copies, filters, sorts.
  virtual Result<PairSet> read_back() = 0;
  // Work done since load; empty when the engine does not count.
  [[nodiscard]] virtual std::vector<Counter> counters() const { return {}; }
};

}  // namespace broadside::core

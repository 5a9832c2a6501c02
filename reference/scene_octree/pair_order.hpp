// Pairs into canonical order: by i, then by j.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/pair.hpp"

namespace broadside::reference {

// Two passes: pairs are dealt by the high bits of i into buckets that fit a core's cache, then each bucket is placed by
// counting i, and each row (one i) is sorted by j. The order is total, so the result does not depend on threads.
class PairOrder {
 public:
  // The pairs have i < body_count and no duplicates. Replaces out.
  void order(std::span<const std::span<const core::Pair>> blocks, std::uint32_t body_count,
             std::vector<core::Pair>& out);

 private:
  std::vector<core::Pair> dealt_;
  std::vector<std::uint64_t> counts_;
  std::vector<std::uint64_t> bucket_begin_;
};

}  // namespace broadside::reference

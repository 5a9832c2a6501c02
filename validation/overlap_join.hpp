// The exact set of overlapping pairs among boxes: the validators' own, written independently of every engine.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/pair.hpp"

namespace broadside::validation {

// Every pair i < j whose closed boxes overlap on all three axes by float comparison (touching counts), without pairs of
// two static bodies; sorted. NaN bounds and min > max overlap nothing.
//
// How: boxes are ordered along a Morton curve of their centers and grouped eight by eight into a hierarchy of bounding
// boxes, which is joined with itself. About O(n log n + pairs) for boxes of similar size; correct for any.
// Many boxes are joined on all threads; the pairs are the same for any number of them.
// is_static: one entry per box, or empty when none is.
class OverlapJoin {
 public:
  const std::vector<core::Pair>& join(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static);

 private:
  void order_boxes(std::span<const core::Box> boxes);
  void build_levels();
  void join_self(std::uint32_t level, std::uint32_t index, std::vector<core::Pair>& out) const;
  void join_cross(std::uint32_t level, std::uint32_t p, std::uint32_t q, std::vector<core::Pair>& out) const;
  void join_pieces();
  void sort_range(std::uint32_t first, std::uint32_t last, std::vector<core::Pair>& out) const;
  void sort_pieces(std::uint32_t bodies);
  [[nodiscard]] std::uint32_t size(std::uint32_t level) const {
    return static_cast<std::uint32_t>(levels_[level].size());
  }
  void emit(std::uint32_t p, std::uint32_t q, std::vector<core::Pair>& out) const;

  std::vector<std::uint32_t> id_;     // of the boxes in order
  std::vector<std::uint8_t> static_;  // in order
  // levels_[0]: the boxes in order; levels_[k + 1][i] bounds levels_[k][8 i .. 8 i + 7].
  std::vector<std::vector<core::Box>> levels_;
  std::vector<core::Pair> pairs_;
  // Of a large join: by piece, and by range of first bodies.
  std::vector<std::vector<core::Pair>> found_;
  std::vector<std::vector<core::Pair>> sorted_;
};

}  // namespace broadside::validation

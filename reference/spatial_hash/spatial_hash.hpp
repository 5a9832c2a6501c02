// The broad phase with which the paper compares: a uniform grid of cells, hashed. METHOD section 2, "Spatial hash".
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/pair.hpp"

namespace broadside::reference {

// Keeps its memory between calls. Works in the caller's oneTBB arena; the pairs do not depend on its size.
//
// A body is entered in every cell that its closed box touches, and bodies that share a cell are tested with P(6). Each
// pair is reported in one cell only, the lowest that both touch, so nothing is found twice. Two departures from the
// paper: a body that touches more than kMostCells cells is entered in none and tested against all instead, because its
// entries would outgrow memory; and cells 2^21 apart on an axis share a key, which costs tests and changes no answer.
class SpatialHash {
 public:
  // 16 cells a side. In the method's scenes a body is 1 m and a cell 0.25 m: 5 a side.
  static constexpr std::uint64_t kMostCells = 4096;

  // Edge of a cell, m, > 0.
  explicit SpatialHash(float cell_m) : cell_m_(cell_m) {}

  // All boxes finite, min <= max; one mark per box. Both are copied.
  void build(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static);
  // Every overlapping pair that is not of two static bodies, once, sorted.
  void find(std::vector<core::Pair>& out);

  // Entries of the last build: bodies times the cells that each touches.
  [[nodiscard]] std::size_t entry_count() const { return entries_.size(); }
  [[nodiscard]] std::size_t oversized_count() const { return oversized_.size(); }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Range {
    Cell low;
    Cell high;
  };
  // Sorted by key, then by body: a total order, so the sorted entries are one sequence whatever the threads do.
  struct Entry {
    std::uint64_t key;
    std::uint32_t body;
    friend auto operator<=>(const Entry&, const Entry&) = default;
  };

  [[nodiscard]] std::int64_t cell_of(float coordinate) const;
  [[nodiscard]] Range cells_of(const core::Box& box) const;
  [[nodiscard]] bool is_pair(std::uint32_t a, std::uint32_t b) const;
  void enter_all();
  void test_cells(std::size_t begin, std::size_t end, std::vector<core::Pair>& out) const;
  void test_oversized(std::uint32_t body, std::vector<core::Pair>& out) const;

  float cell_m_;
  std::vector<core::Box> boxes_;
  std::vector<std::uint8_t> is_static_;
  std::vector<Range> ranges_;
  std::vector<std::uint64_t> first_entry_;  // per body, and the total behind the last
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> oversized_;
  std::vector<std::uint8_t> is_oversized_;
  std::vector<std::vector<core::Pair>> found_;  // per block of entries
};

}  // namespace broadside::reference

#include "reference/spatial_hash/spatial_hash.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>

namespace broadside::reference {
namespace {

using core::Pair;

// Entries of one task of the search: about a hundred cells of the method's scenes.
constexpr std::size_t kBlock = 1024;
// Cells beyond 2^40 are clamped to one cell: that is beyond any scene, and far from where int64 ends. Clamping keeps
// the order, so no pair is lost.
constexpr double kFarCell = 1099511627776.0;

// 21 bits an axis.
std::uint64_t key_of(const std::array<std::int64_t, 3>& cell) {
  constexpr std::uint64_t kMask = (1U << 21U) - 1U;
  return (static_cast<std::uint64_t>(cell[0]) & kMask) << 42U | (static_cast<std::uint64_t>(cell[1]) & kMask) << 21U |
         (static_cast<std::uint64_t>(cell[2]) & kMask);
}

}  // namespace

// Rounding and floor are monotone: boxes that touch at a coordinate both touch the cell of that coordinate. So no pair
// is lost, whatever the rounding of the division.
std::int64_t SpatialHash::cell_of(float coordinate) const {
  const double cell = std::floor(static_cast<double>(coordinate) / static_cast<double>(cell_m_));
  return static_cast<std::int64_t>(std::clamp(cell, -kFarCell, kFarCell));
}

SpatialHash::Range SpatialHash::cells_of(const core::Box& box) const {
  Range range;
  for (int axis = 0; axis < 3; ++axis) {
    range.low[axis] = cell_of(box.min[axis]);
    range.high[axis] = cell_of(box.max[axis]);
  }
  return range;
}

bool SpatialHash::is_pair(std::uint32_t a, std::uint32_t b) const {
  return (is_static_[a] == 0 || is_static_[b] == 0) && core::overlaps(boxes_[a], boxes_[b]);
}

void SpatialHash::build(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) {
  boxes_.assign(boxes.begin(), boxes.end());
  is_static_.assign(is_static.begin(), is_static.end());
  ranges_.resize(boxes.size());
  is_oversized_.assign(boxes.size(), 0);
  oversized_.clear();
  first_entry_.assign(boxes.size() + 1, 0);
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    ranges_[i] = cells_of(boxes_[i]);
    std::uint64_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto width = static_cast<std::uint64_t>(ranges_[i].high[axis] - ranges_[i].low[axis]) + 1;
      cells = width > kMostCells ? kMostCells + 1 : std::min(kMostCells + 1, cells * width);
    }
    if (cells > kMostCells) {
      is_oversized_[i] = 1;
      oversized_.push_back(static_cast<std::uint32_t>(i));
      cells = 0;
    }
    first_entry_[i + 1] = first_entry_[i] + cells;
  }
  entries_.resize(first_entry_.back());
  enter_all();
  tbb::parallel_sort(entries_.begin(), entries_.end());
}

void SpatialHash::enter_all() {
  tbb::parallel_for(std::size_t{0}, boxes_.size(), [&](std::size_t i) {
    if (is_oversized_[i] != 0) return;
    Entry* entry = entries_.data() + first_entry_[i];
    const auto& [low, high] = ranges_[i];
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) *entry++ = {key_of({x, y, z}), static_cast<std::uint32_t>(i)};
  });
}

// The cells whose first entry is in [begin, end); the last of them may reach beyond.
void SpatialHash::test_cells(std::size_t begin, std::size_t end, std::vector<Pair>& out) const {
  std::size_t at = begin;
  while (at > 0 && at < end && entries_[at].key == entries_[at - 1].key) ++at;
  while (at < end) {
    std::size_t past = at + 1;
    while (past < entries_.size() && entries_[past].key == entries_[at].key) ++past;
    for (std::size_t a = at; a < past; ++a) {
      const std::uint32_t i = entries_[a].body;
      for (std::size_t b = a + 1; b < past; ++b) {
        const std::uint32_t j = entries_[b].body;
        if (!is_pair(i, j)) continue;
        std::array<std::int64_t, 3> lowest_of_both;
        for (int axis = 0; axis < 3; ++axis)
          lowest_of_both[axis] = std::max(ranges_[i].low[axis], ranges_[j].low[axis]);
        if (key_of(lowest_of_both) == entries_[at].key) out.push_back({i, j});  // i < j: entries are sorted
      }
    }
    at = past;
  }
}

// Tests a body against all bodies; of two oversized bodies the lower id reports the pair.
void SpatialHash::test_oversized(std::uint32_t body, std::vector<Pair>& out) const {
  for (std::uint32_t other = 0; other < boxes_.size(); ++other) {
    if (other == body || (is_oversized_[other] != 0 && other < body)) continue;
    if (is_pair(body, other)) out.push_back(core::make_pair_of(body, other));
  }
}

void SpatialHash::find(std::vector<Pair>& out) {
  const std::size_t blocks = (entries_.size() + kBlock - 1) / kBlock;
  found_.resize(std::max(found_.size(), blocks + oversized_.size()));
  tbb::parallel_for(std::size_t{0}, blocks + oversized_.size(), [&](std::size_t k) {
    found_[k].clear();
    if (k < blocks)
      test_cells(k * kBlock, std::min(entries_.size(), (k + 1) * kBlock), found_[k]);
    else
      test_oversized(oversized_[k - blocks], found_[k]);
  });
  out.clear();
  for (std::size_t k = 0; k < blocks + oversized_.size(); ++k)
    out.insert(out.end(), found_[k].begin(), found_[k].end());
  tbb::parallel_sort(out.begin(), out.end());
}

}  // namespace broadside::reference

#include "validation/overlap_join.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace broadside::validation {
namespace {

using core::Box;
using core::Vec3;

constexpr std::uint32_t kArity = 8;
// From this many boxes on, a join is shared by threads.
constexpr std::size_t kParallelFrom = 20000;
// Pieces of a join that threads share: enough that one slow piece does not delay all.
constexpr std::uint32_t kLeastPieces = 64;

// Spreads the low 21 bits so that two zeros follow each.
std::uint64_t spread(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

// NaN and infinite centers all land in cell 0: the order is only for speed.
std::uint64_t cell(float center, float low, double per_cell) {
  const double c = (static_cast<double>(center) - low) * per_cell;
  return c >= 0.0 && c < 0x1p21 ? static_cast<std::uint64_t>(c) : 0;
}

Box joined(const Box& a, const Box& b) {
  const auto low = [](float p, float q) { return q < p ? q : p; };
  const auto high = [](float p, float q) { return q > p ? q : p; };
  return {{low(a.min.x, b.min.x), low(a.min.y, b.min.y), low(a.min.z, b.min.z)},
          {high(a.max.x, b.max.x), high(a.max.y, b.max.y), high(a.max.z, b.max.z)}};
}

bool is_solid(const Box& b) {
  return b.min.x <= b.max.x && b.min.y <= b.max.y && b.min.z <= b.max.z;
}

bool meet(const Box& a, const Box& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
         b.min.z <= a.max.z;
}

}  // namespace

void OverlapJoin::order_boxes(std::span<const Box> boxes) {
  Box extent = core::empty_box();
  const auto center_of = [](const Box& b) {
    return Vec3{0.5F * b.min.x + 0.5F * b.max.x, 0.5F * b.min.y + 0.5F * b.max.y, 0.5F * b.min.z + 0.5F * b.max.z};
  };
  for (const Box& box : boxes) {
    const Vec3 c = center_of(box);
    if (is_solid(box) && std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z))
      extent = core::grown(extent, c);
  }
  const auto scale = [](float low, float high) {
    return high > low ? 0x1.fffffp20 / (static_cast<double>(high) - low) : 0.0;
  };
  const double sx = scale(extent.min.x, extent.max.x);
  const double sy = scale(extent.min.y, extent.max.y);
  const double sz = scale(extent.min.z, extent.max.z);

  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!is_solid(boxes[i])) continue;
    const Vec3 c = center_of(boxes[i]);
    order.emplace_back(spread(cell(c.x, extent.min.x, sx)) | spread(cell(c.y, extent.min.y, sy)) << 1 |
                           spread(cell(c.z, extent.min.z, sz)) << 2,
                       i);
  }
  if (order.size() < kParallelFrom)
    std::sort(order.begin(), order.end());
  else
    tbb::parallel_sort(order.begin(), order.end());
  id_.clear();
  for (const auto& [code, i] : order) id_.push_back(i);
}

void OverlapJoin::build_levels() {
  while (levels_.back().size() > 1) {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> level;
    level.reserve(below.size() / kArity + 1);
    for (std::size_t first = 0; first < below.size(); first += kArity) {
      Box bounds = below[first];
      for (std::size_t k = first + 1; k < std::min(first + kArity, below.size()); ++k)
        bounds = joined(bounds, below[k]);
      level.push_back(bounds);
    }
    levels_.push_back(std::move(level));
  }
}

void OverlapJoin::emit(std::uint32_t p, std::uint32_t q, std::vector<core::Pair>& out) const {
  if (!static_.empty() && static_[p] != 0 && static_[q] != 0) return;
  out.push_back(core::make_pair_of(id_[p], id_[q]));
}

void OverlapJoin::join_self(std::uint32_t level, std::uint32_t index, std::vector<core::Pair>& out) const {
  if (level == 0) return;
  const std::uint32_t first = index * kArity;
  const std::uint32_t last = std::min(first + kArity, size(level - 1));
  for (std::uint32_t p = first; p < last; ++p) {
    join_self(level - 1, p, out);
    for (std::uint32_t q = p + 1; q < last; ++q)
      if (meet(levels_[level - 1][p], levels_[level - 1][q])) join_cross(level - 1, p, q, out);
  }
}

// Whether the two nodes' bounds overlap.
void OverlapJoin::join_cross(std::uint32_t level, std::uint32_t p, std::uint32_t q,
                             std::vector<core::Pair>& out) const {
  if (level == 0) return emit(p, q, out);
  const std::vector<Box>& below = levels_[level - 1];
  const Box& bounds_q = levels_[level][q];
  const std::uint32_t last_p = std::min(p * kArity + kArity, size(level - 1));
  const std::uint32_t last_q = std::min(q * kArity + kArity, size(level - 1));
  for (std::uint32_t r = p * kArity; r < last_p; ++r) {
    if (!meet(below[r], bounds_q)) continue;
    for (std::uint32_t s = q * kArity; s < last_q; ++s)
      if (meet(below[r], below[s])) join_cross(level - 1, r, s, out);
  }
}

// Piece k: node k of a high level with itself and with all later ones.
void OverlapJoin::join_pieces() {
  auto level = static_cast<std::uint32_t>(levels_.size()) - 1;
  while (level > 0 && size(level) < kLeastPieces) --level;
  const std::uint32_t pieces = size(level);
  found_.resize(pieces);
  tbb::parallel_for(std::uint32_t{0}, pieces, [&](std::uint32_t p) {
    std::vector<core::Pair>& out = found_[p];
    out.clear();
    join_self(level, p, out);
    for (std::uint32_t q = p + 1; q < pieces; ++q)
      if (meet(levels_[level][p], levels_[level][q])) join_cross(level, p, q, out);
  });
}

// Those pairs of all pieces whose first body is in [first, last), sorted: by first body with one count each, then each
// body's few partners. A comparison sort of millions of pairs costs more than finding them.
void OverlapJoin::sort_range(std::uint32_t first, std::uint32_t last, std::vector<core::Pair>& out) const {
  std::vector<std::uint32_t> end(last - first + 1, 0);
  for (const std::vector<core::Pair>& piece : found_)
    for (const core::Pair p : piece)
      if (p.i >= first && p.i < last) ++end[p.i - first + 1];
  for (std::size_t k = 1; k < end.size(); ++k) end[k] += end[k - 1];
  std::vector<std::uint32_t> partner(end.back());
  for (const std::vector<core::Pair>& piece : found_)
    for (const core::Pair p : piece)
      if (p.i >= first && p.i < last) partner[end[p.i - first]++] = p.j;
  // end[k] is now one past the partners of body first + k.
  out.resize(partner.size());
  std::uint32_t next = 0;
  for (std::uint32_t i = first; i < last; ++i) {
    std::sort(partner.begin() + next, partner.begin() + end[i - first]);
    for (; next < end[i - first]; ++next) out[next] = {i, partner[next]};
  }
}

void OverlapJoin::sort_pieces(std::uint32_t bodies) {
  const auto parts = static_cast<std::uint32_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
  const std::uint32_t each = bodies / parts + 1;
  sorted_.resize(parts);
  tbb::parallel_for(std::uint32_t{0}, parts, [&](std::uint32_t k) {
    sort_range(std::min(bodies, k * each), std::min(bodies, k * each + each), sorted_[k]);
  });
  std::size_t sum = 0;
  for (const std::vector<core::Pair>& part : sorted_) sum += part.size();
  pairs_.clear();
  pairs_.reserve(sum);
  for (const std::vector<core::Pair>& part : sorted_) pairs_.insert(pairs_.end(), part.begin(), part.end());
}

const std::vector<core::Pair>& OverlapJoin::join(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  pairs_.clear();
  order_boxes(boxes);
  levels_.assign(1, {});
  static_.clear();
  levels_[0].reserve(id_.size());
  for (const std::uint32_t i : id_) {
    levels_[0].push_back(boxes[i]);
    if (!is_static.empty()) static_.push_back(is_static[i]);
  }
  if (id_.empty()) return pairs_;
  build_levels();
  if (id_.size() < kParallelFrom) {
    join_self(static_cast<std::uint32_t>(levels_.size()) - 1, 0, pairs_);
    std::sort(pairs_.begin(), pairs_.end());
    return pairs_;
  }
  join_pieces();
  sort_pieces(static_cast<std::uint32_t>(boxes.size()));
  return pairs_;
}

}  // namespace broadside::validation

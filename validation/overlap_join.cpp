#include "validation/overlap_join.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace broadside::validation {
namespace {

using core::Box;
using core::Vec3;

constexpr std::uint32_t kArity = 8;

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
  std::sort(order.begin(), order.end());
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

void OverlapJoin::emit(std::uint32_t p, std::uint32_t q) {
  if (!static_.empty() && static_[p] != 0 && static_[q] != 0) return;
  pairs_.push_back(core::make_pair_of(id_[p], id_[q]));
}

void OverlapJoin::join_self(std::uint32_t level, std::uint32_t index) {
  if (level == 0) return;
  const std::uint32_t first = index * kArity;
  const std::uint32_t last = std::min(first + kArity, size(level - 1));
  for (std::uint32_t p = first; p < last; ++p) {
    join_self(level - 1, p);
    for (std::uint32_t q = p + 1; q < last; ++q)
      if (meet(levels_[level - 1][p], levels_[level - 1][q])) join_cross(level - 1, p, q);
  }
}

// The two nodes' bounds meet.
void OverlapJoin::join_cross(std::uint32_t level, std::uint32_t p, std::uint32_t q) {
  if (level == 0) return emit(p, q);
  const std::vector<Box>& below = levels_[level - 1];
  const Box& bounds_q = levels_[level][q];
  const std::uint32_t last_p = std::min(p * kArity + kArity, size(level - 1));
  const std::uint32_t last_q = std::min(q * kArity + kArity, size(level - 1));
  for (std::uint32_t r = p * kArity; r < last_p; ++r) {
    if (!meet(below[r], bounds_q)) continue;
    for (std::uint32_t s = q * kArity; s < last_q; ++s)
      if (meet(below[r], below[s])) join_cross(level - 1, r, s);
  }
}

// By first body with one count each, then each body's few partners: a comparison sort of millions of pairs costs more
// than finding them.
void OverlapJoin::sort_pairs(std::size_t bodies) {
  begin_.assign(bodies + 1, 0);
  for (const core::Pair p : pairs_) ++begin_[p.i + 1];
  for (std::size_t i = 1; i <= bodies; ++i) begin_[i] += begin_[i - 1];
  partner_.resize(pairs_.size());
  for (const core::Pair p : pairs_) partner_[begin_[p.i]++] = p.j;
  // begin_[i] is now the end of body i's partners.
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < bodies; ++i) {
    const std::size_t end = begin_[i];
    std::sort(partner_.begin() + static_cast<std::ptrdiff_t>(next),
              partner_.begin() + static_cast<std::ptrdiff_t>(end));
    for (; next < end; ++next) pairs_[next] = {i, partner_[next]};
  }
}

const std::vector<core::Pair>& OverlapJoin::join(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  pairs_.clear();
  order_boxes(boxes);
  levels_.assign(1, {});
  static_.clear();
  for (const std::uint32_t i : id_) {
    levels_[0].push_back(boxes[i]);
    if (!is_static.empty()) static_.push_back(is_static[i]);
  }
  if (!id_.empty()) {
    build_levels();
    join_self(static_cast<std::uint32_t>(levels_.size()) - 1, 0);
  }
  sort_pairs(boxes.size());
  return pairs_;
}

}  // namespace broadside::validation

#include "gpu/broad/group_buffers.hpp"

#include <algorithm>
#include <cmath>

namespace broadside::gpu {
namespace {

// Up to 2^18 cells there are as many cells as boxes; beyond, a cell for five boxes. More cells leave more groups that
// are not full, since the last group of each chunk of cells is not; fewer cells leave more boxes in no order, since
// those of one cell have none. 150,000 boxes of bunnies take 0.083 ms on an H100 by 2^18 cells, 0.094 by 2^15.
constexpr std::uint32_t kLeastAxisBits = 3;
constexpr std::uint32_t kFineAxisBits = 6;
constexpr std::uint32_t kMostAxisBits = 8;
constexpr std::uint64_t kBoxesPerCell = 5;

// Boxes of a mesh's triangles give 7 to 30 overlapping pairs of groups for each group, long thin boxes 900.
constexpr std::uint64_t kExpectedPairsPerGroup = 32;
constexpr std::uint64_t kMostPairsPerGroup = 64;

std::uint32_t axis_bits_for(std::uint32_t boxes) {
  std::uint32_t bits = kLeastAxisBits;
  while (bits < kFineAxisBits && (1U << 3 * bits) < boxes) ++bits;
  while (bits < kMostAxisBits && (kBoxesPerCell << 3 * bits) < boxes) ++bits;
  return bits;
}

std::uint64_t groups_of(std::uint64_t members) {
  return (members + kGroupSize - 1) / kGroupSize;
}

}  // namespace

core::Status GroupBuffers::load(const BoxFacts& facts) {
  const std::uint64_t boxes = facts.count;
  view_ = {};
  view_.axis_bits = axis_bits_for(facts.count);
  // The last group of a chunk may have one box.
  most_groups_ = groups_of(boxes) + std::min<std::uint64_t>(boxes, view_.chunks());
  BROADSIDE_TRY(count_.reserve(view_.cells(), "groups of boxes"));
  BROADSIDE_TRY(count_.fill_bytes(0));
  BROADSIDE_TRY(begin_.reserve(view_.cells(), "groups of boxes"));
  BROADSIDE_TRY(rank_.reserve(boxes, "groups of boxes"));
  BROADSIDE_TRY(chunk_room_.reserve(std::size_t{view_.chunks()} + 1, "groups of boxes"));
  BROADSIDE_TRY(entries_.reserve(most_groups_ * kGroupSize, "groups of boxes"));
  BROADSIDE_TRY(groups_.reserve(most_groups_, "groups of boxes"));
  BROADSIDE_TRY(clusters_.reserve(groups_of(most_groups_), "groups of boxes"));
  BROADSIDE_TRY(group_pairs_.reserve(most_groups_ * kExpectedPairsPerGroup, "pairs of groups"));
  refit(facts);
  return core::Done{};
}

void GroupBuffers::refit(const BoxFacts& facts) {
  const core::Vec3 side = facts.domain.max - facts.domain.min;
  const float longest = std::max({side.x, side.y, side.z});
  view_.corner = facts.domain.min;
  // If all boxes are at one point, or too far apart for a float, all are in one cell.
  const bool has_cells = longest > 0.0F && std::isfinite(longest);
  const float cells_per_m = has_cells ? static_cast<float>(1U << view_.axis_bits) / longest : 0.0F;
  view_.cells_per_m = std::isfinite(cells_per_m) ? cells_per_m : 0.0F;
}

core::Result<bool> GroupBuffers::grow(std::uint64_t group_pairs) {
  if (group_pairs <= group_pairs_.capacity()) return true;
  if (group_pairs > most_groups_ * kMostPairsPerGroup) return false;
  BROADSIDE_TRY(group_pairs_.reserve(group_pairs, "pairs of groups"));
  return true;
}

GroupView GroupBuffers::view() const {
  GroupView view = view_;
  view.count = count_.data();
  view.begin = begin_.data();
  view.rank = rank_.data();
  view.chunk_room = chunk_room_.data();
  view.entry_count = view.chunk_room + view.chunks();
  view.entries = entries_.data();
  view.groups = groups_.data();
  view.clusters = clusters_.data();
  view.group_pairs = {group_pairs_.data(), group_pairs_.capacity()};
  return view;
}

std::uint64_t GroupBuffers::bytes() const {
  return count_.bytes() + begin_.bytes() + rank_.bytes() + chunk_room_.bytes() + entries_.bytes() + groups_.bytes() +
         clusters_.bytes() + group_pairs_.bytes();
}

}  // namespace broadside::gpu

#include "gpu/broad/apart_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace broadside::gpu {
namespace {

using core::Box;

// Bits of coarse cells for each static box: so many that few cells share a bit. All words together fit a GPU's cache.
constexpr std::uint64_t kBitsPerBox = 16;
constexpr std::uint64_t kMostWords = 1ULL << 22U;

// The most cells of a level at which a moving box looks along an axis: some 4,000 rows of cells.
constexpr float kMostCells = 64.0F;

}  // namespace

bool is_worth_keeping_apart(std::span<const std::uint8_t> is_static, const PairFinderOptions& options) {
  if (options.broad != Broad::kTree || is_static.size() < options.least_for_apart) return false;
  const auto standing = static_cast<std::size_t>(
      std::count_if(is_static.begin(), is_static.end(), [](std::uint8_t flag) { return flag != 0; }));
  return 8 * standing >= is_static.size() && standing < is_static.size();
}

void ApartSearch::start(std::span<const std::uint8_t> is_static, const PairFinderOptions& options) {
  options_ = options;
  options_.has_shares = true;
  standing_ids_.clear();
  moving_ids_.clear();
  for (std::uint32_t i = 0; i < is_static.size(); ++i) (is_static[i] != 0 ? standing_ids_ : moving_ids_).push_back(i);
  has_table_ = false;
  static_builds_ = static_boxes_kept_ = bytes_to_device_ = 0;
}

core::Result<bool> ApartSearch::load_standing(std::span<const Box> boxes, const Stream& stream) {
  const auto is_as_before = [&] {
    for (std::size_t k = 0; k < standing_ids_.size(); ++k)
      if (!(boxes[standing_ids_[k]] == standing_boxes_[k])) return false;
    return true;
  };
  if (has_table_ && is_as_before()) {
    static_boxes_kept_ += standing_ids_.size();
    return true;
  }
  has_table_ = false;
  packed_.clear();
  standing_boxes_.clear();
  FactsOfBoxes facts;
  for (const std::uint32_t id : standing_ids_) {
    facts.add(boxes[id]);
    packed_.push_back(pack(boxes[id], id, 1U));
    standing_boxes_.push_back(boxes[id]);
  }
  if (!fits_grid(facts.all())) return false;
  auto room = standing_.room_for(packed_.size());
  if (!room.ok()) return room.error();
  BROADSIDE_TRY(copy_to_device(room.value(), packed_.data(), packed_.size() * sizeof(PackedBox)));
  bytes_to_device_ += packed_.size() * sizeof(PackedBox);
  PairFinderOptions none_found = options_;
  none_found.pairs_at_once = 1;
  BROADSIDE_TRY(standing_.load_packed(facts.all(), none_found, true));
  // The share is empty, so no box looks for partners: the launch only puts the boxes in order.
  BROADSIDE_TRY(standing_.launch_share({}, stream.get()));
  BROADSIDE_TRY(stream.wait("putting static boxes in order"));
  const BulkView& table = standing_.view().bulk;
  std::uint32_t levels = 0;
  BROADSIDE_TRY(copy_to_host(&levels, table.levels, sizeof levels));
  float largest_side_m = facts.all().largest_side_m;
  for (const std::uint32_t id : moving_ids_) {
    const core::Vec3 side = boxes[id].max - boxes[id].min;
    largest_side_m = std::max({largest_side_m, side.x, side.y, side.z});
  }
  cross_.cells.bounds = facts.all().domain;
  BROADSIDE_TRY(mark_cells(largest_side_m, stream));
  finest_cell_m_ = std::ldexp(table.cell_m, 1 - static_cast<int>(std::bit_width(levels)));
  ++static_builds_;
  has_table_ = true;
  return true;
}

// `largest_side_m`: the largest side of any box of this frame, static or moving.
core::Status ApartSearch::mark_cells(float largest_side_m, const Stream& stream) {
  const std::uint64_t count = standing_ids_.size();
  const std::uint64_t words = std::min(kMostWords, std::bit_ceil(kBitsPerBox * count / 32 + 1));
  BROADSIDE_TRY(cell_words_.reserve(words, "cells of static boxes"));
  BROADSIDE_TRY(cell_words_.fill_bytes(0));
  BROADSIDE_TRY(wait_for_device("clearing the cells of static boxes"));
  StandingCells& cells = cross_.cells;
  cells.words = cell_words_.data();
  cells.word_mask = static_cast<std::uint32_t>(words - 1);
  // The clamp keeps the inverse a normal number.
  cells.cells_per_m = 1.0F / std::clamp(largest_side_m, 0x1p-100F, 0x1p100F);
  BROADSIDE_TRY(launch_mark({standing_.view().boxes, static_cast<std::uint32_t>(count), cells}, stream.get()));
  return stream.wait("marking the cells of static boxes");
}

core::Result<bool> ApartSearch::load_moving(std::span<const Box> boxes) {
  packed_.clear();
  FactsOfBoxes facts;
  for (const std::uint32_t id : moving_ids_) {
    facts.add(boxes[id]);
    packed_.push_back(pack(boxes[id], id, 0U));
  }
  if (!fits_grid(facts.all()) || facts.all().largest_side_m > kMostCells * finest_cell_m_) return false;
  auto room = moving_.room_for(packed_.size());
  if (!room.ok()) return room.error();
  BROADSIDE_TRY(copy_to_device(room.value(), packed_.data(), packed_.size() * sizeof(PackedBox)));
  bytes_to_device_ += packed_.size() * sizeof(PackedBox);
  BROADSIDE_TRY(moving_.load_packed(facts.all(), options_, false));
  if (near_.capacity() <= packed_.size()) {
    BROADSIDE_TRY(near_.reserve(packed_.size() + 1, "moving boxes near static ones"));
    BROADSIDE_TRY(near_.fill_bytes(0));
    BROADSIDE_TRY(wait_for_device("clearing a count of boxes"));
  }
  return true;
}

core::Result<bool> ApartSearch::load(std::span<const Box> boxes, const Stream& stream) {
  auto is_good = load_standing(boxes, stream);
  if (!is_good.ok() || !is_good.value() || !has_moving()) return is_good;
  is_good = load_moving(boxes);
  if (!is_good.ok() || !is_good.value()) return is_good;
  auto shape = cross_launch_shape();
  if (!shape.ok()) return shape.error();
  cross_shape_ = shape.value();
  return true;
}

core::Status ApartSearch::launch(StreamHandle stream) {
  NamedPairsView share;
  // If the moving boxes have consecutive numbers, no pair has to look up the numbers of its two boxes.
  const bool are_in_a_row = moving_ids_.back() - moving_ids_.front() + 1 == moving_ids_.size();
  if (are_in_a_row)
    share.names.base = moving_ids_.front();
  else
    share.names.first_told = 0;
  share.end_place = moving_ids_.size();
  BROADSIDE_TRY(moving_.launch_share(share, stream));
  const PairsView& moving = moving_.view();
  cross_.standing = standing_.view().bulk;
  cross_.standing_boxes = standing_.view().boxes;
  cross_.moving_boxes = moving.boxes;
  cross_.count = moving.box_count;
  cross_.near_count = near_.data();
  cross_.near = near_.data() + 1;
  cross_.pairs = moving.pairs;
  cross_.counters = moving.counters;
  cross_.barrier = moving.barrier;
  cross_.outcome = moving.outcome;
  return launch_cross(cross_, cross_shape_, stream);
}

}  // namespace broadside::gpu

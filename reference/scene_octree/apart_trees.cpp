#include "reference/scene_octree/apart_trees.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>

namespace broadside::reference {
namespace {

using core::Box;

constexpr std::size_t kLeastBoxes = 4096;
constexpr std::size_t kIdGrain = 16'384;

void gather(std::span<const Box> boxes, std::span<const std::uint32_t> ids, std::vector<Box>& to) {
  to.resize(ids.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ids.size(), kIdGrain), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) to[k] = boxes[ids[k]];
  });
}

// A box with NaN equals none, so it counts as changed in every frame.
bool are_as_before(std::span<const Box> boxes, std::span<const std::uint32_t> ids, const std::vector<Box>& before) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, ids.size(), kIdGrain), true,
      [&](const auto& range, bool is_same) {
        for (std::size_t k = range.begin(); k != range.end(); ++k) is_same = is_same && boxes[ids[k]] == before[k];
        return is_same;
      },
      std::logical_and<>());
}

}  // namespace

bool is_worth_keeping_apart(std::span<const std::uint8_t> is_static) {
  if (is_static.size() < kLeastBoxes) return false;
  const auto moving = static_cast<std::size_t>(std::count(is_static.begin(), is_static.end(), std::uint8_t{0}));
  return 8U * (is_static.size() - moving) >= is_static.size();
}

void ApartTrees::start(std::span<const std::uint8_t> is_static) {
  static_ids_.clear();
  moving_ids_.clear();
  for (std::uint32_t i = 0; i < is_static.size(); ++i) (is_static[i] != 0 ? static_ids_ : moving_ids_).push_back(i);
  none_static_.assign(moving_ids_.size(), 0);
  has_static_tree_ = false;
  static_builds_ = static_boxes_kept_ = 0;
  moving_.reset_counts();
}

bool ApartTrees::build_static(std::span<const Box> boxes) {
  if (has_static_tree_ && are_as_before(boxes, static_ids_, static_boxes_)) {
    static_boxes_kept_ += static_ids_.size();
    return true;
  }
  gather(boxes, static_ids_, static_boxes_);
  // Moving boxes search this tree and see its boxes as static; the tree itself is not searched for pairs of its own
  // boxes.
  has_static_tree_ = static_.build(static_boxes_, std::vector<std::uint8_t>(static_ids_.size(), 1));
  if (!has_static_tree_) return false;
  static_.renumber(static_ids_);
  ++static_builds_;
  return true;
}

bool ApartTrees::build(std::span<const Box> boxes) {
  if (!build_static(boxes)) return false;
  gather(boxes, moving_ids_, moving_boxes_);
  if (!moving_.build(moving_boxes_, none_static_)) return false;
  moving_.renumber(moving_ids_);
  return true;
}

void ApartTrees::find() {
  moving_.find();
  moving_.find_more(static_);
}

void ApartTrees::read_back(std::vector<core::Pair>& out) {
  order_.order(moving_.found_blocks(), static_cast<std::uint32_t>(static_ids_.size() + moving_ids_.size()), out);
}

}  // namespace broadside::reference

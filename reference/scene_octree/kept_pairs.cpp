#include "reference/scene_octree/kept_pairs.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>

namespace broadside::reference {
namespace {

using core::Box;
using core::Pair;
using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t kBoxGrain = 16'384;
// How much a box is fattened on each side, as a share of its mean side. A box that moves by a hundredth a frame stays
// within its fat one for six frames, and there are some (1 + 1/8)^3 = 1.4 times as many candidate pairs.
constexpr float kFat = 0x1p-4F;
constexpr std::uint32_t kMostPause = 64;

}  // namespace

void KeptPairs::start(std::span<const std::uint8_t> is_static) {
  is_static_.assign(is_static.begin(), is_static.end());
  tree_.reset_counts();
  is_fat_ = has_candidates_ = is_kept_ = false;
  has_served_ = true;
  in_vain_ = pause_ = 0;
  searched_frames_ = kept_frames_ = candidates_tested_ = 0;
}

// A box with NaN is within nothing.
bool KeptPairs::are_within(std::span<const Box> boxes) const {
  return tbb::parallel_reduce(
      Range(0, boxes.size(), kBoxGrain), true,
      [&](const Range& range, bool all) {
        for (std::size_t i = range.begin(); i != range.end() && all; ++i) {
          const Box& b = boxes[i];
          const Box& f = fat_[i];
          all = (f.min.x <= b.min.x) & (f.min.y <= b.min.y) & (f.min.z <= b.min.z) & (b.max.x <= f.max.x) &
                (b.max.y <= f.max.y) & (b.max.z <= f.max.z) & (b.min.x <= b.max.x) & (b.min.y <= b.max.y) &
                (b.min.z <= b.max.z);
        }
        return all;
      },
      std::logical_and<>());
}

void KeptPairs::fatten(std::span<const Box> boxes) {
  fat_.resize(boxes.size());
  tbb::parallel_for(Range(0, boxes.size(), kBoxGrain), [&](const Range& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const core::Vec3 sides = boxes[i].max - boxes[i].min;
      const float fat_m = kFat / 3.0F * ((sides.x + sides.y) + sides.z);
      const core::Vec3 fat{fat_m, fat_m, fat_m};
      fat_[i] = {boxes[i].min - fat, boxes[i].max + fat};
    }
  });
}

bool KeptPairs::build(std::span<const Box> boxes) {
  is_kept_ = has_candidates_ && are_within(boxes);
  if (!is_kept_) {
    if (has_candidates_) {
      in_vain_ = has_served_ ? 0 : in_vain_ + 1;
      if (in_vain_ > 0) pause_ = std::min(kMostPause, 1U << std::min(in_vain_, 6U));
    }
    has_candidates_ = false;
    is_fat_ = pause_ == 0;
    if (is_fat_) {
      fatten(boxes);
      // A fat box may reach beyond the largest float; then the boxes are searched as they are.
      is_fat_ = tree_.build(fat_, is_static_) && tree_.plan().is_plain();
      has_served_ = false;
    } else {
      --pause_;
    }
    if (!is_fat_ && !tree_.build(boxes, is_static_)) return false;
  }
  if (!is_fat_) return true;
  if (!is_kept_) {
    tree_.order_of_boxes(id_of_place_);
    place_of_id_.resize(boxes.size());
    for (std::uint32_t place = 0; place < id_of_place_.size(); ++place) place_of_id_[id_of_place_[place]] = place;
  }
  placed_.resize(boxes.size());
  tbb::parallel_for(Range(0, boxes.size(), kBoxGrain), [&](const Range& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) placed_[k] = boxes[id_of_place_[k]];
  });
  return true;
}

void KeptPairs::find() {
  if (is_kept_) {
    has_served_ = true;
    ++kept_frames_;
    test_candidates();
    return;
  }
  ++searched_frames_;
  tree_.find();
  if (!is_fat_) return;
  take_candidates();
  test_candidates();
}

void KeptPairs::take_candidates() {
  const auto blocks = tree_.found_blocks();
  candidates_.resize(blocks.size());
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    candidates_[b].clear();
    candidates_[b].reserve(blocks[b].size());
    for (const Pair p : blocks[b]) candidates_[b].push_back({place_of_id_[p.i], place_of_id_[p.j]});
  });
  has_candidates_ = true;
}

void KeptPairs::test_candidates() {
  settled_.clear();
  for (const auto& block : candidates_) candidates_tested_ += block.size();
  tbb::parallel_for(std::size_t{0}, candidates_.size(), [&](std::size_t b) {
    PairWriter& writer = settled_.writer();
    constexpr std::size_t kAtOnce = 64;
    const std::vector<Pair>& block = candidates_[b];
    for (std::size_t first = 0; first < block.size(); first += kAtOnce) {
      Pair* to = writer.room(kAtOnce);
      for (std::size_t k = first; k < std::min(first + kAtOnce, block.size()); ++k) {
        const Pair p = block[k];
        *to = core::make_pair_of(id_of_place_[p.i], id_of_place_[p.j]);
        to += core::overlaps(placed_[p.i], placed_[p.j]) ? 1 : 0;
      }
      writer.commit(to);
    }
  });
}

void KeptPairs::read_back(std::vector<Pair>& out) {
  if (is_fat_)
    order_.order(settled_.gather(), static_cast<std::uint32_t>(is_static_.size()), out);
  else
    tree_.read_back(out);
}

}  // namespace broadside::reference

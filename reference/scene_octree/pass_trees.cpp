#include "reference/scene_octree/pass_trees.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "reference/scene_octree/box_check.hpp"

namespace broadside::reference {

using core::Box;
using core::Pair;

bool PassTrees::build(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  plan_ = core::plan_passes(boxes, 0.0F, least_boxes_);
  if (plan_.is_plain()) return plain_.build(boxes, is_static);
  // A map of a pass may turn a box that is not sound into a sound one, so boxes are checked before.
  if (!check_boxes(boxes).ok()) return false;
  take(boxes, is_static);
  while (passes_.size() < plan_.passes.size()) passes_.push_back(std::make_unique<Pass>());
  bool is_built = true;
  for (std::size_t k = 0; k < plan_.passes.size(); ++k) {
    gather(plan_.passes[k], *passes_[k]);
    is_built = passes_[k]->tree.build(passes_[k]->mapped, passes_[k]->is_static) && is_built;
  }
  return is_built;
}

void PassTrees::take(std::span<const Box> boxes, std::span<const std::uint8_t> is_static) {
  boxes_.assign(boxes.begin(), boxes.end());
  is_static_.assign(is_static.begin(), is_static.end());
  group_.resize(boxes.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      group_[i] = static_cast<std::uint8_t>(plan_.group(boxes_[i]));
  });
}

void PassTrees::gather(const core::BoxPass& plan, Pass& pass) const {
  pass.ids.clear();
  pass.is_static.clear();
  for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
    if (!plan.has(group_[i])) continue;
    pass.ids.push_back(i);
    pass.is_static.push_back(is_static_[i]);
  }
  pass.mapped.resize(pass.ids.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pass.ids.size(), 4096), [&](const auto& range) {
    for (std::size_t k = range.begin(); k != range.end(); ++k) pass.mapped[k] = plan.map(boxes_[pass.ids[k]]);
  });
}

void PassTrees::find() {
  if (plan_.is_plain()) {
    plain_.find();
    return;
  }
  settled_.clear();
  for (std::size_t k = 0; k < plan_.passes.size(); ++k) {
    passes_[k]->tree.find();
    settle(plan_.passes[k], *passes_[k]);
  }
}

void PassTrees::settle(const core::BoxPass& plan, Pass& pass) {
  const auto blocks = pass.tree.found_blocks();
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    PairWriter& writer = settled_.writer();
    for (const Pair local : blocks[b]) {
      const std::uint32_t i = pass.ids[local.i];
      const std::uint32_t j = pass.ids[local.j];
      if (!plan.keeps(group_[i], group_[j]) || !core::overlaps(boxes_[i], boxes_[j])) continue;
      Pair* to = writer.room(1);
      *to = core::make_pair_of(i, j);
      writer.commit(to + 1);
    }
  });
}

void PassTrees::read_back(std::vector<Pair>& out) {
  if (plan_.is_plain())
    plain_.read_back(out);
  else
    order_.order(settled_.gather(), static_cast<std::uint32_t>(boxes_.size()), out);
}

std::uint64_t PassTrees::nodes_visited() const {
  std::uint64_t sum = plain_.nodes_visited();
  for (const auto& pass : passes_) sum += pass->tree.nodes_visited();
  return sum;
}

std::uint64_t PassTrees::packs_tested() const {
  std::uint64_t sum = plain_.packs_tested();
  for (const auto& pass : passes_) sum += pass->tree.packs_tested();
  return sum;
}

void PassTrees::reset_counts() {
  plain_.reset_counts();
  for (const auto& pass : passes_) pass->tree.reset_counts();
}

}  // namespace broadside::reference

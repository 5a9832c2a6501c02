// The fast exact broad phase for any boxes: one SizeTree over the boxes as they are, or, where
// core/method/box_passes.hpp finds that too slow, one SizeTree for each pass.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/method/box_passes.hpp"
#include "core/pair.hpp"
#include "reference/scene_octree/pair_blocks.hpp"
#include "reference/scene_octree/pair_order.hpp"
#include "reference/scene_octree/size_tree.hpp"

namespace broadside::reference {

// Keeps its memory between calls. Works in the caller's oneTBB arena.
class PassTrees {
 public:
  explicit PassTrees(std::uint32_t least_boxes = core::kLeastBoxesForPasses) : least_boxes_(least_boxes) {}

  // False, with nothing built, when a box is not finite or inside out. is_static has one entry per box.
  [[nodiscard]] bool build(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static);
  // Every overlapping pair that is not of two static bodies, once, in no fixed order.
  void find();
  // The pairs of the last find, in canonical order.
  void read_back(std::vector<core::Pair>& out);

  // The pairs of the last find where the workers left them, in no fixed order.
  [[nodiscard]] std::span<const std::span<const core::Pair>> found_blocks() {
    return plan_.is_plain() ? plain_.found_blocks() : settled_.gather();
  }
  // Where there are no passes: the ids of all boxes in the tree's order.
  void order_of_boxes(std::vector<std::uint32_t>& ids) const { plain_.order_of_boxes(ids); }

  [[nodiscard]] const core::PassPlan& plan() const { return plan_; }
  // Sums over all finds since reset_counts(), the same for any number of threads.
  [[nodiscard]] std::uint64_t nodes_visited() const;
  [[nodiscard]] std::uint64_t packs_tested() const;
  void reset_counts();

 private:
  // The boxes of one pass in its coordinates, and the tree over them.
  struct Pass {
    std::vector<core::Box> mapped;
    std::vector<std::uint8_t> is_static;
    std::vector<std::uint32_t> ids;
    SizeTree tree;
  };

  void take(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static);
  void gather(const core::BoxPass& plan, Pass& pass) const;
  // Keeps what a tree found, without the pairs that overlap in its coordinates alone or that another pass keeps.
  void settle(const core::BoxPass& plan, Pass& pass);

  std::uint32_t least_boxes_;
  core::PassPlan plan_;
  std::vector<std::unique_ptr<Pass>> passes_;
  SizeTree plain_;
  // Of all boxes, where there are passes.
  std::vector<core::Box> boxes_;
  std::vector<std::uint8_t> is_static_;
  std::vector<std::uint8_t> group_;
  PairBlocks settled_;
  PairOrder order_;
};

}  // namespace broadside::reference

// The fast exact broad phase on CPU threads: a packed octree per size class (core/method/size_tree.hpp).
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/pair.hpp"
#include "reference/scene_octree/box_buckets.hpp"
#include "reference/scene_octree/pair_blocks.hpp"
#include "reference/scene_octree/pair_order.hpp"
#include "reference/scene_octree/tree_view.hpp"

namespace broadside::reference {

enum class Simd { kFastest, kPortable };

// Keeps its memory between calls: in steady state a call allocates nothing. Works in the caller's oneTBB arena.
class SizeTree {
 public:
  explicit SizeTree(Simd simd = Simd::kFastest);

  // False, with nothing built, when a box is not finite or inside out. is_static has one entry per box.
  [[nodiscard]] bool build(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static);
  // Every overlapping pair that is not of two static bodies, once, in no fixed order.
  void find();
  // After build: all boxes' ids, class by class along the curve.
  void order_of_boxes(std::vector<std::uint32_t>& ids) const;
  // Adds to the pairs of find the overlapping pairs of this tree's boxes with those of another tree, whose ids must
  // differ.
  void find_more(const SizeTree& other);
  // After build: box k is called ids[k] from now on.
  void renumber(std::span<const std::uint32_t> ids);
  // The pairs of the last find, in canonical order. For a tree that was renumbered, use found_blocks.
  void read_back(std::vector<core::Pair>& out);

  [[nodiscard]] std::uint64_t found() const { return found_.count(); }
  // The pairs of the last find where the workers left them, in no fixed order.
  [[nodiscard]] std::span<const std::span<const core::Pair>> found_blocks() { return found_.gather(); }
  // Work of all finds since reset_counts(): sums of integers, so the same for any number of threads.
  [[nodiscard]] std::uint64_t nodes_visited() const { return nodes_visited_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t packs_tested() const { return packs_tested_.load(std::memory_order_relaxed); }
  void reset_counts() { nodes_visited_ = packs_tested_ = 0; }
  [[nodiscard]] std::size_t class_count() const { return classes_.size(); }

 private:
  void lay_out();
  void fill_bucket(std::size_t bucket);
  void fill_upper_levels();
  [[nodiscard]] TreeView view() const;
  void join(const TreeView& tree, const TreeView& other);

  JoinKernel join_;
  std::uint32_t body_count_ = 0;
  BoxBuckets buckets_;
  std::vector<std::uint32_t> first_pack_;  // of each bucket
  std::vector<TreeClass> classes_;
  std::vector<BoxPack> packs_;
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint8_t> static_lanes_;
  PairBlocks found_;
  PairOrder pair_order_;
  std::atomic<std::uint64_t> nodes_visited_{0};
  std::atomic<std::uint64_t> packs_tested_{0};
};

}  // namespace broadside::reference

// The fast exact broad phase on CPU threads: a packed octree per size class (core/method/size_tree.hpp).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/method/size_tree.hpp"
#include "core/pair.hpp"
#include "reference/scene_octree/key_sort.hpp"
#include "reference/scene_octree/pair_blocks.hpp"
#include "reference/scene_octree/pair_order.hpp"
#include "reference/scene_octree/size_classes.hpp"
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
  // The pairs of the last find, in canonical order.
  void read_back(std::vector<core::Pair>& out);

  [[nodiscard]] std::uint64_t found() const { return found_.count(); }
  [[nodiscard]] std::size_t class_count() const { return plan_.counts.size(); }

 private:
  // What one chunk of boxes adds to the survey.
  struct Survey {
    core::Box half_centers = core::empty_box();
    core::Box bounds = core::empty_box();
    std::array<std::uint32_t, core::kSizeBins> sizes{};
    bool is_sound = true;
  };
  struct Run {
    std::uint32_t begin;
    std::uint32_t end;
  };

  void survey(std::span<const core::Box> boxes);
  void sort_boxes(std::span<const core::Box> boxes);
  void sort_long_runs(std::span<const core::Box> boxes);
  void sort_run(std::span<const core::Box> boxes, Run run, bool alone);
  void find_runs(std::size_t begin, std::size_t end, std::vector<Run>& runs) const;
  void lay_out();
  void fill_packs(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static);
  void fill_upper_levels();
  [[nodiscard]] TreeView view() const;

  JoinKernel join_;
  std::vector<Survey> surveys_;
  Survey whole_;
  SizeClasses plan_;
  std::vector<KeyedId> sorted_;
  std::vector<KeyedId> scratch_;
  KeySort key_sort_;
  std::vector<TreeClass> classes_;
  std::vector<std::uint32_t> first_box_;  // of each class, in sorted order
  std::vector<BoxPack> packs_;
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint8_t> static_lanes_;
  PairBlocks found_;
  PairOrder pair_order_;
};

}  // namespace broadside::reference

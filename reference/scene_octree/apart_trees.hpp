// Static and moving boxes in separate trees: where many boxes are static, a frame costs what the moving ones cost. The
// static tree is built once and kept for as long as its boxes stay the same, which is checked in every frame. Moving
// boxes look for partners among themselves and in the static tree. Two static boxes are never tested.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/pair.hpp"
#include "reference/scene_octree/pair_order.hpp"
#include "reference/scene_octree/size_tree.hpp"

namespace broadside::reference {

// Whether separate trees are worth while: at least an eighth of the boxes must be static, and there must be enough
// boxes, because building a small tree takes microseconds.
bool is_worth_keeping_apart(std::span<const std::uint8_t> is_static);

// Keeps its memory between calls. Works in the caller's oneTBB arena.
class ApartTrees {
 public:
  // Says which boxes are static. Call it before the first build with them.
  void start(std::span<const std::uint8_t> is_static);
  // False when a box is not finite or inside out. There must be as many boxes as start() was given.
  [[nodiscard]] bool build(std::span<const core::Box> boxes);
  void find();
  void read_back(std::vector<core::Pair>& out);

  // Counted since start.
  [[nodiscard]] std::uint64_t static_builds() const { return static_builds_; }
  [[nodiscard]] std::uint64_t static_boxes_kept() const { return static_boxes_kept_; }
  [[nodiscard]] std::uint64_t nodes_visited() const { return moving_.nodes_visited(); }
  [[nodiscard]] std::uint64_t packs_tested() const { return moving_.packs_tested(); }

 private:
  [[nodiscard]] bool build_static(std::span<const core::Box> boxes);

  std::vector<std::uint32_t> static_ids_;
  std::vector<std::uint32_t> moving_ids_;
  std::vector<core::Box> static_boxes_;  // as the static tree has them
  std::vector<core::Box> moving_boxes_;
  std::vector<std::uint8_t> none_static_;
  SizeTree static_;
  SizeTree moving_;
  PairOrder order_;
  bool has_static_tree_ = false;
  std::uint64_t static_builds_ = 0;
  std::uint64_t static_boxes_kept_ = 0;
};

}  // namespace broadside::reference

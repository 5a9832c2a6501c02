// The scene octree of METHOD section 2 on CPU threads: P-Alg 1 as published, P-Alg 2 in its sound form or as printed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/box.hpp"
#include "core/method/scene_octree.hpp"
#include "core/pair.hpp"
#include "core/scene/octree_node.hpp"
#include "core/variant.hpp"
#include "reference/scene_octree/pair_blocks.hpp"
#include "reference/scene_octree/pair_order.hpp"

namespace broadside::reference {

// Keeps its memory between calls: in steady state a call allocates nothing. Works in the caller's oneTBB arena.
class SceneOctree {
 public:
  // depth: levels below the root, at most core::kMaxSceneOctreeDepth. Of the variants, printed-E2 tests only bodies
  // stored in the same node, printed-E7 builds no level below 1; all others search soundly.
  explicit SceneOctree(int depth = core::kSceneOctreeDepth, core::Variant variant = core::Variant::kSound);

  // The overlapping pairs of the boxes, sorted, without pairs of two static bodies: exact for any domain, the same bits
  // for any thread count. is_static has one entry per box.
  void find_pairs(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static, const core::Box& domain,
                  std::vector<core::Pair>& out);

  // The two halves of find_pairs, and the sorting, for callers that time them separately.
  void build(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static, const core::Box& domain);
  void find();
  void read_back(std::vector<core::Pair>& out);

  [[nodiscard]] int depth() const { return depth_; }
  // The node in which each body is stored, in order of id. Valid after build.
  [[nodiscard]] std::span<const core::SceneNode> nodes() const { return nodes_; }
  // The complete octree to which these nodes belong, as OctreeRecord::tell_octree gives it.
  void tell_octree(std::vector<core::OctreeNode>& nodes, std::vector<std::uint32_t>& node_of_body) const;
  // Box tests of the last find.
  [[nodiscard]] std::uint64_t tests() const { return tests_; }

 private:
  int depth_;
  bool same_node_only_;
  core::Box domain_;
  std::vector<core::SceneNode> nodes_;
  std::vector<std::uint64_t> order_;      // node key above body id, sorted
  std::vector<std::uint32_t> range_end_;  // of each place in the order: one past its last candidate's place
  std::vector<float> min_x_, min_y_, min_z_, max_x_, max_y_, max_z_;  // in order of place
  std::vector<std::uint32_t> id_;
  std::vector<std::uint8_t> is_static_;
  std::uint64_t tests_ = 0;
  PairBlocks found_;
  PairOrder pair_order_;
};

}  // namespace broadside::reference

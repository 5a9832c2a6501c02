#include "reference/scene_octree/broad_phases.hpp"

#include <string>
#include <utility>
#include <vector>

#include "core/engine/search_path.hpp"
#include "reference/scene_octree/apart_trees.hpp"
#include "reference/scene_octree/box_check.hpp"
#include "reference/scene_octree/octree_record.hpp"
#include "reference/scene_octree/own_arena.hpp"
#include "reference/scene_octree/pass_trees.hpp"
#include "reference/scene_octree/scene_octree.hpp"

namespace broadside::reference {
namespace {

core::Box bounds_of(std::span<const core::Box> boxes) {
  core::Box bounds = core::empty_box();
  for (const core::Box& box : boxes) bounds = core::grown(core::grown(bounds, box.min), box.max);
  return bounds;
}

class SceneOctreeBroadPhase final : public core::BroadPhase, public OctreeRecord {
 public:
  SceneOctreeBroadPhase(const core::Box& domain, int depth, core::Variant variant, int threads)
      : arena_(threads), octree_(depth, variant), domain_(domain), domain_is_given_(!core::is_empty(domain)) {
    traits_.exact = variant != core::Variant::kE2;
  }

  [[nodiscard]] core::BroadPhaseTraits traits() const override { return traits_; }

  core::Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    is_static_.assign(is_static.begin(), is_static.end());
    box_tests_ = 0;
    if (!domain_is_given_) domain_ = bounds_of(boxes);
    return update(boxes);
  }

  core::Status update(std::span<const core::Box> boxes) override {
    if (core::Status s = check_box_count(boxes.size(), is_static_.size()); !s) return s;
    core::Status status = core::Done{};
    arena_.execute([&] {
      status = check_boxes(boxes);
      if (status.ok()) octree_.build(boxes, is_static_, domain_);
    });
    return status;
  }

  core::Status find() override {
    arena_.execute([&] { octree_.find(); });
    box_tests_ += octree_.tests();
    return core::Done{};
  }

  [[nodiscard]] std::vector<core::Counter> counters() const override { return {{"broad: box tests", box_tests_}}; }

  core::Result<core::PairSet> read_back() override {
    core::PairSet set;
    arena_.execute([&] { octree_.read_back(set.pairs); });
    set.demanded = set.raw = set.pairs.size();
    return set;
  }

  void tell_octree(std::vector<core::OctreeNode>& nodes, std::vector<std::uint32_t>& node_of_body) const override {
    octree_.tell_octree(nodes, node_of_body);
  }

 private:
  OwnArena arena_;
  SceneOctree octree_;
  core::BroadPhaseTraits traits_;
  core::Box domain_;
  bool domain_is_given_;
  std::uint64_t box_tests_ = 0;
  std::vector<std::uint8_t> is_static_;
};

class TreeBroadPhase final : public core::BroadPhase, public core::TellsPath {
 public:
  explicit TreeBroadPhase(int threads) : arena_(threads) {}

  [[nodiscard]] core::BroadPhaseTraits traits() const override { return {}; }

  core::Status load(std::span<const core::Box> boxes, std::span<const std::uint8_t> is_static) override {
    is_static_.assign(is_static.begin(), is_static.end());
    tree_.reset_counts();
    is_apart_ = is_worth_keeping_apart(is_static) && core::plan_passes(boxes).is_plain();
    if (is_apart_) apart_.start(is_static);
    return update(boxes);
  }

  core::Status update(std::span<const core::Box> boxes) override {
    if (core::Status s = check_box_count(boxes.size(), is_static_.size()); !s) return s;
    bool is_sound = true;
    arena_.execute([&] { is_sound = is_apart_ ? apart_.build(boxes) : tree_.build(boxes, is_static_); });
    if (!is_sound) return unsound_box(boxes);
    return core::Done{};
  }

  core::Status find() override {
    arena_.execute([&] {
      if (is_apart_)
        apart_.find();
      else
        tree_.find();
    });
    return core::Done{};
  }

  [[nodiscard]] std::vector<core::Counter> counters() const override {
    if (!is_apart_)
      return {{"broad: nodes visited", tree_.nodes_visited()}, {"broad: box tests", 8U * tree_.packs_tested()}};
    return {{"broad: nodes visited", apart_.nodes_visited()},
            {"broad: box tests", 8U * apart_.packs_tested()},
            {"broad: static trees built", apart_.static_builds()},
            {"broad: static boxes kept", apart_.static_boxes_kept()}};
  }

  [[nodiscard]] std::string path() const override {
    return is_apart_ ? "static boxes in a tree that is kept, moving ones in a tree of each frame"
                     : core::words_of(tree_.plan());
  }

  core::Result<core::PairSet> read_back() override {
    core::PairSet set;
    arena_.execute([&] {
      if (is_apart_)
        apart_.read_back(set.pairs);
      else
        tree_.read_back(set.pairs);
    });
    set.demanded = set.raw = set.pairs.size();
    return set;
  }

 private:
  OwnArena arena_;
  PassTrees tree_;
  ApartTrees apart_;
  bool is_apart_ = false;
  std::vector<std::uint8_t> is_static_;
};

}  // namespace

std::unique_ptr<core::BroadPhase> make_tree_broad_phase(int threads) {
  return std::make_unique<TreeBroadPhase>(threads);
}

std::unique_ptr<core::BroadPhase> make_scene_octree_broad_phase(const core::Box& domain, int depth,
                                                                core::Variant variant, int threads) {
  return std::make_unique<SceneOctreeBroadPhase>(domain, depth, variant, threads);
}

}  // namespace broadside::reference

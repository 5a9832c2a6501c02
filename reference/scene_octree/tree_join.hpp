// The search of one pack of boxes, for any vector type. Included once by each file that is compiled for an instruction
// set; everything here has internal linkage, so that no two of them share code.
//
// Where boxes are spread, a test finds one overlap on average, so the branch on it is mispredicted half the time, which
// costs more than the test. Hence lists: each stage tests everything in its list and appends what overlaps to the next
// stage's list, writing all eight lanes and advancing by the number of hits. Only the ends of lists are branches.
//
// Lanes is the vector code:
//   struct Box;                                      one box in every lane
//   Box spread(const BoxPack&, lane);                that lane's box in every lane
//   unsigned overlapping(const BoxPack&, Box);       bit k: box k of the pack overlaps, P(6)
//   uint32_t* append(to, base, hits);                writes base + k for each hit, and may write all 8; the new end
//   FoundPair* emit(to, ids, id, hits);              writes the pair of id and ids[k] likewise
#pragma once

#include <cstddef>
#include <cstdint>

#include "reference/scene_octree/tree_view.hpp"

// NOLINTBEGIN(google-build-namespaces, misc-definitions-in-headers): internal linkage, as said above
namespace broadside::reference {
namespace {

// Entries of a list: enough that a box of usual size does not fill one, few enough that all lists stay in L1 (8 KiB).
constexpr std::uint32_t kListSize = 256;
// A giant's list is handed to the next stage when it holds this many; one more append always fits.
constexpr std::uint32_t kListFull = kListSize - 8U;

template <typename Lanes>
class Join {
 public:
  // Packs of `tree` look for partners in `other`: in itself, or in a tree of other boxes.
  Join(const TreeView& tree, const TreeView& other, PairSink& sink)
      : tree_(tree), other_(other), is_itself_(&tree == &other), sink_(sink) {}

  // pack: its number within its class.
  void search(std::uint32_t pack_class, std::uint32_t pack) {
    const TreeClass& own = tree_.classes[pack_class];
    own_pack_ = own.level_begin[0] + pack;
    bounds_ = Lanes::spread(tree_.packs[own.level_begin[1] + pack / 8U], pack % 8U);
    if (!is_itself_) {
      for (std::uint32_t c = 0; c < other_.class_count; ++c) walk(other_.classes[c], 0);
      return;
    }
    // core::finds: within a class the first of two packs finds the pair, between classes the pack of the finer one.
    walk(own, pack);
    for (std::uint32_t c = pack_class + 1U; c < tree_.class_count; ++c) walk(tree_.classes[c], 0);
  }

 private:
  // Tests every pack of the class from `first` on whose bounds overlap.
  void walk(const TreeClass& of, std::uint32_t first) {
    class_ = &of;
    first_ = first;
    lists_[of.level_count - 1U][0] = 0;
    descend(of.level_count - 1U, 1);
  }

  // The listed nodes of a level, by number within it, overlap: lists those of their children that do.
  void descend(std::uint32_t level, std::uint32_t count) {
    if (level == 0) {
      narrow(count);
      return;
    }
    sink_.nodes_visited += count;
    const BoxPack* nodes = other_.packs + class_->level_begin[level];
    const std::uint32_t first_child = first_ >> (3U * (level - 1U));
    std::uint32_t* const begin = lists_[level - 1U];
    std::uint32_t* end = begin;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t node = lists_[level][k];
      const std::uint32_t child = node * 8U;
      unsigned hits = Lanes::overlapping(nodes[node], bounds_);
      // Children whose packs all come before `first` were searched from there.
      hits &= ~0U << (first_child > child ? first_child - child : 0U);
      end = Lanes::append(end, child, hits);
      if (end - begin > kListFull) {
        descend(level - 1U, static_cast<std::uint32_t>(end - begin));
        end = begin;
      }
    }
    if (end != begin) descend(level - 1U, static_cast<std::uint32_t>(end - begin));
  }

  // The listed packs overlap the bounds of ours: lists which of our boxes overlap the bounds of each of them.
  void narrow(std::uint32_t count) {
    const BoxPack& own = tree_.packs[own_pack_];
    const unsigned own_static = tree_.static_lanes[own_pack_];
    sink_.packs_tested += count;
    const BoxPack* parents = other_.packs + class_->level_begin[1];
    const std::uint8_t* static_lanes = other_.static_lanes + class_->level_begin[0];
    std::uint32_t* end = near_;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t pack = lists_[0][k];
      unsigned near = Lanes::overlapping(own, Lanes::spread(parents[pack / 8U], pack % 8U));
      // A static box has nothing to look for in a pack of static ones.
      near &= ~(static_lanes[pack] == 0xFFU ? own_static : 0U);
      end = Lanes::append(end, pack * 8U, near);
      if (end - near_ > kListFull) {
        test(static_cast<std::uint32_t>(end - near_));
        end = near_;
      }
    }
    test(static_cast<std::uint32_t>(end - near_));
  }

  // Tests each listed box of ours against the boxes of the pack that is listed with it: 8 pack + lane of ours.
  void test(std::uint32_t count) {
    const BoxPack& own = tree_.packs[own_pack_];
    const std::uint32_t* own_ids = tree_.ids + std::size_t{8} * own_pack_;
    const unsigned own_static = tree_.static_lanes[own_pack_];
    sink_.packs_tested += count;
    const std::uint32_t packs = class_->level_begin[0];
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t lane = near_[k] % 8U;
      const std::uint32_t pack = packs + near_[k] / 8U;
      unsigned hits = Lanes::overlapping(other_.packs[pack], Lanes::spread(own, lane));
      // Within our own pack only the lanes after ours count, and never a pair of two static bodies.
      hits &= is_itself_ && pack == own_pack_ ? ~1U << lane : ~0U;
      hits &= ~(other_.static_lanes[pack] & (0U - (own_static >> lane & 1U)));
      if (sink_.end - sink_.next < 8) sink_.more(sink_);
      sink_.next = Lanes::emit(sink_.next, other_.ids + std::size_t{8} * pack, own_ids[lane], hits);
    }
  }

  const TreeView& tree_;
  const TreeView& other_;
  bool is_itself_;
  PairSink& sink_;
  const TreeClass* class_ = nullptr;
  std::uint32_t own_pack_ = 0;
  std::uint32_t first_ = 0;
  typename Lanes::Box bounds_;
  std::uint32_t lists_[kMostTreeLevels][kListSize];
  std::uint32_t near_[kListSize];
};

}  // namespace
}  // namespace broadside::reference
// NOLINTEND(google-build-namespaces, misc-definitions-in-headers)

// The search of one pack of boxes, for any vector type. Included once by each file that is compiled for an instruction
// set; everything here has internal linkage, so that no two of them share code.
//
// Lanes is the vector code:
//   struct Box;                                      one box in every lane
//   Box spread(const BoxPack&, lane);                that lane's box in every lane
//   unsigned overlapping(const BoxPack&, Box);       bit k: box k of the pack overlaps, P(6)
#pragma once

#include <cstddef>
#include <cstdint>

#include "reference/scene_octree/tree_view.hpp"

namespace broadside::reference {
namespace {

// Each level adds at most 7 to a stack of depth-first search.
constexpr std::uint32_t kMostStack = 8U * kMostTreeLevels;

template <typename Lanes>
class Join {
 public:
  Join(const TreeView& tree, PairSink& sink) : tree_(tree), sink_(sink) {}

  // pack: its number within its class.
  void search(std::uint32_t pack_class, std::uint32_t pack) {
    const TreeClass& own = tree_.classes[pack_class];
    a_ = own.level_begin[0] + pack;
    const BoxPack& bounds_pack = tree_.packs[own.level_begin[1] + pack / 8U];
    const auto bounds = Lanes::spread(bounds_pack, pack % 8U);
    // core::finds: within the class, packs that come first find; from classes that are finer, all.
    walk(own, bounds, pack);
    for (std::uint32_t other = pack_class + 1U; other < tree_.class_count; ++other)
      walk(tree_.classes[other], bounds, 0);
  }

 private:
  struct Node {
    std::uint32_t level;
    std::uint32_t index;
  };

  // Tests every pack of the class from `first` on whose bounds overlap.
  void walk(const TreeClass& of, const typename Lanes::Box& bounds, std::uint32_t first) {
    Node stack[kMostStack];
    std::uint32_t depth = 0;
    stack[depth++] = {of.level_count - 1U, 0};
    while (depth > 0) {
      const Node node = stack[--depth];
      const BoxPack& children = tree_.packs[of.level_begin[node.level] + node.index];
      unsigned hits = Lanes::overlapping(children, bounds);
      // Children whose packs all come before `first` were searched from there.
      const std::uint32_t first_child = first >> (3U * (node.level - 1U));
      const std::uint32_t child = node.index * 8U;
      if (first_child > child) hits &= ~0U << (first_child - child);
      if (node.level > 1U) {
        for (; hits != 0; hits &= hits - 1U)
          stack[depth++] = {node.level - 1U, child + static_cast<std::uint32_t>(__builtin_ctz(hits))};
      } else {
        for (; hits != 0; hits &= hits - 1U) {
          const auto lane = static_cast<std::uint32_t>(__builtin_ctz(hits));
          test(of.level_begin[0] + child + lane, children, lane);
        }
      }
    }
  }

  // Boxes of pack a_ against boxes of pack b, whose bounds are a lane of `parent`.
  void test(std::uint32_t b, const BoxPack& parent, std::uint32_t lane) {
    const BoxPack& boxes_a = tree_.packs[a_];
    const BoxPack& boxes_b = tree_.packs[b];
    unsigned near = Lanes::overlapping(boxes_a, Lanes::spread(parent, lane));
    if (near == 0) return;
    if (sink_.end - sink_.next < 64) sink_.more(sink_);
    const std::uint32_t* ids_a = tree_.ids + std::size_t{8} * a_;
    const std::uint32_t* ids_b = tree_.ids + std::size_t{8} * b;
    const unsigned static_a = tree_.static_lanes[a_];
    const unsigned static_b = tree_.static_lanes[b];
    FoundPair* next = sink_.next;
    for (; near != 0; near &= near - 1U) {
      const auto k = static_cast<std::uint32_t>(__builtin_ctz(near));
      unsigned hits = Lanes::overlapping(boxes_b, Lanes::spread(boxes_a, k));
      if (b == a_) hits &= ~1U << k;
      if ((static_a >> k & 1U) != 0) hits &= ~static_b;
      const std::uint32_t id = ids_a[k];
      for (; hits != 0; hits &= hits - 1U) {
        const std::uint32_t other = ids_b[__builtin_ctz(hits)];
        *next++ = {id < other ? id : other, id < other ? other : id};
      }
    }
    sink_.next = next;
  }

  const TreeView& tree_;
  PairSink& sink_;
  std::uint32_t a_ = 0;
};

}  // namespace
}  // namespace broadside::reference

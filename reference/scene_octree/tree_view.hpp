// The built tree as the search kernels see it: plain arrays. Included by files that are compiled for one instruction
// set each, so it has no function that a linker might share between them.
#pragma once

#include <cstdint>

namespace broadside::reference {

// Eight boxes, or the bounds of eight packs below. Lanes without a box hold min = inf, max = -inf, which overlap
// nothing.
struct alignas(64) BoxPack {
  float min_x[8];
  float min_y[8];
  float min_z[8];
  float max_x[8];
  float max_y[8];
  float max_z[8];
};
static_assert(sizeof(BoxPack) == 192, "three cache lines");

// 8^10 packs of 8 boxes are more than 32-bit ids can number.
inline constexpr int kMostTreeLevels = 12;

// One size class. Level 0 is its packs of boxes; the only pack of the top level holds the bounds of up to eight below.
struct TreeClass {
  std::uint32_t level_count;  // at least 2
  std::uint32_t packs;        // at level 0
  // Index of each level's first pack in TreeView::packs. Level 0 of all classes comes first, in order of class, so a
  // pack's index there also numbers its ids.
  std::uint32_t level_begin[kMostTreeLevels];
};

struct TreeView {
  const BoxPack* packs;
  const TreeClass* classes;
  const std::uint32_t* ids;          // 8 for each pack of level 0
  const std::uint8_t* static_lanes;  // for each pack of level 0, a bit for each lane with a static body or none
  std::uint32_t class_count;
};

// A pair as two ids; the layout of core::Pair.
struct FoundPair {
  std::uint32_t i;
  std::uint32_t j;
};

// Where a kernel puts pairs: [next, end) is free. When room is short, the kernel calls more, which takes the pairs
// written so far and sets both.
struct PairSink {
  FoundPair* next;
  FoundPair* end;
  void* owner;
  void (*more)(PairSink& sink);
  // Work done: tests of one box against a pack of eight, on the way down and among the boxes themselves. Counted by
  // list, not by test, so that counting costs no measurable time.
  std::uint64_t nodes_visited = 0;
  std::uint64_t packs_tested = 0;
};

// Finds all pairs that packs [first, last) of a class own: pairs within the tree, or, where `other` is another tree,
// pairs of the tree's boxes with all boxes of the other one. Every kernel finds the same set.
using JoinKernel = void (*)(const TreeView& tree, const TreeView& other, std::uint32_t pack_class, std::uint32_t first,
                            std::uint32_t last, PairSink& sink);

void join_portable(const TreeView& tree, const TreeView& other, std::uint32_t pack_class, std::uint32_t first,
                   std::uint32_t last, PairSink& sink);
void join_avx2(const TreeView& tree, const TreeView& other, std::uint32_t pack_class, std::uint32_t first,
               std::uint32_t last, PairSink& sink);

}  // namespace broadside::reference

// The fast broad phase finds exactly the overlapping pairs, whatever the boxes, the threads and the instruction set.
#include "reference/scene_octree/size_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "reference/scene_octree/broad_phases.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::tests {
namespace {

using core::Pair;
using reference::Simd;
using reference::SizeTree;

std::vector<Pair> pairs_of(SizeTree& tree, const BoxCase& c) {
  std::vector<Pair> pairs;
  EXPECT_TRUE(tree.build(c.boxes, c.is_static));
  tree.find();
  tree.read_back(pairs);
  return pairs;
}

class EveryKernel : public testing::TestWithParam<Simd> {};

// Counts around the edges of packs (8), nodes (64, 512), tiles (64) and the run that is sorted again (64).
TEST_P(EveryKernel, FindsExactlyTheOverlappingPairs) {
  SizeTree tree(GetParam());
  for (const BoxFamily& family : kBoxFamilies) {
    for (const std::uint32_t count : {0U, 1U, 2U, 7U, 8U, 9U, 63U, 64U, 65U, 66U, 511U, 513U, 1500U}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const std::string wrong =
            disagreement(make_case(family, count, seed), [&](const BoxCase& c) { return pairs_of(tree, c); });
        ASSERT_EQ(wrong, "") << family.name << ", seed " << seed;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(SizeTree, EveryKernel, testing::Values(Simd::kFastest, Simd::kPortable),
                         [](const auto& param) { return param.param == Simd::kFastest ? "fastest" : "portable"; });

std::vector<Pair> pairs_of(core::BroadPhase& broad, const BoxCase& c) {
  EXPECT_TRUE(broad.load(c.boxes, c.is_static).ok());
  EXPECT_TRUE(broad.find().ok());
  auto set = broad.read_back();
  EXPECT_TRUE(set.ok());
  return std::move(set.value().pairs);
}

// Large enough for parallel sorting, for a run of equal keys that all workers sort again (one stray far away leaves all
// other boxes in one cell), and for many blocks of pairs. An independent search agrees.
TEST(SizeTree, ManyBoxesAndAnyThreadCountGiveTheSameBits) {
  for (const BoxFamily& family : kBoxFamilies) {
    if (family.name != "uniform" && family.name != "clumps" && family.name != "one stray at 1e30") continue;
    const BoxCase c = make_case(family, 70000, 5);
    const std::vector<Pair> first = pairs_of(*reference::make_tree_broad_phase(1), c);
    for (const int threads : {2, 8})
      ASSERT_EQ(pairs_of(*reference::make_tree_broad_phase(threads), c), first) << family.name << ", " << threads;
    if (family.name != "one stray at 1e30") continue;
    const core::Box around{{-1, -1, -1}, {43, 43, 43}};
    EXPECT_EQ(pairs_of(*reference::make_scene_octree_broad_phase(around, 6), c), first) << family.name;
  }
}

// All in one place: every pair, n (n - 1) / 2 of them.
TEST(SizeTree, IdenticalBoxesAllOverlap) {
  BoxCase c;
  c.boxes.assign(1200, core::Box{{1, 2, 3}, {1, 2, 3}});
  c.is_static.assign(1200, 0);
  SizeTree tree;
  EXPECT_EQ(pairs_of(tree, c).size(), 1200U * 1199U / 2U);
}

TEST(SizeTree, StaticBodiesPairOnlyWithDynamicOnes) {
  BoxCase c;
  c.boxes.assign(100, core::Box{{0, 0, 0}, {1, 1, 1}});
  c.is_static.assign(100, 1);
  SizeTree tree;
  EXPECT_TRUE(pairs_of(tree, c).empty());
  c.is_static[40] = 0;
  EXPECT_EQ(pairs_of(tree, c).size(), 99U);
  // More boxes with one center than a bucket should hold: no grid can split them.
  c.boxes.assign(70000, core::Box{{0, 0, 0}, {1, 1, 1}});
  c.is_static.assign(70000, 1);
  c.is_static[69999] = 0;
  EXPECT_EQ(pairs_of(tree, c).size(), 69999U);
}

// A giant in a pack of small boxes would swell it, so giants get a tree of their own. Sizes that differ threefold do
// not.
TEST(SizeTree, SizesThatDifferMuchGetTreesOfTheirOwn) {
  SizeTree tree;
  BoxCase c = make_case(kBoxFamilies[0], 20000, 1);
  pairs_of(tree, c);
  EXPECT_EQ(tree.class_count(), 1U);
  for (std::size_t k = 0; k < c.boxes.size(); k += 100) c.boxes[k].max = c.boxes[k].min + core::Vec3{20, 20, 20};
  pairs_of(tree, c);
  EXPECT_EQ(tree.class_count(), 2U);
}

TEST(SizeTree, ASecondFrameStartsAfresh) {
  SizeTree tree;
  const BoxCase many = make_case(kBoxFamilies[0], 5000, 1);
  const BoxCase few = make_case(kBoxFamilies[1], 300, 2);
  pairs_of(tree, many);
  EXPECT_EQ(pairs_of(tree, few), every_pair(few));
  EXPECT_EQ(pairs_of(tree, many), every_pair(many));
}

TEST(SizeTree, RefusesBoxesThatAreNotFiniteOrInsideOut) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::uint8_t> is_static(2, 0);
  for (const core::Box& bad : {core::Box{{-kInf, 0, 0}, {1, 1, 1}}, core::Box{{0, 0, nan}, {1, 1, 1}},
                               core::Box{{0, 0, 0}, {1, nan, 1}}, core::Box{{0, 2, 0}, {1, 1, 1}}}) {
    auto broad = reference::make_tree_broad_phase();
    const core::Status status = broad->load(std::vector{core::Box{{0, 0, 0}, {1, 1, 1}}, bad}, is_static);
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().line().find("box 1"), std::string::npos) << status.error().line();
  }
}

}  // namespace
}  // namespace broadside::tests

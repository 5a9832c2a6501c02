// METHOD section 2 and errata E2, E7: the scene octree stores each body in the lowest node that contains its box, and
// finds exactly the overlapping pairs.
#include "reference/scene_octree/scene_octree.hpp"

#include <gtest/gtest.h>

#include "reference/scene_octree/broad_phases.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::tests {
namespace {

using core::Box;
using core::Pair;
using core::Variant;
using reference::SceneOctree;

constexpr Box kDomain{{0, 0, 0}, {4, 4, 4}};

std::vector<Pair> pairs_of(SceneOctree& octree, const BoxCase& c) {
  std::vector<Pair> pairs;
  octree.find_pairs(c.boxes, c.is_static, c.domain, pairs);
  return pairs;
}

BoxCase dynamic_boxes(std::vector<Box> boxes) {
  BoxCase c{std::move(boxes), {}, kDomain};
  c.is_static.assign(c.boxes.size(), 0);
  return c;
}

TEST(SceneOctree, FindsExactlyTheOverlappingPairsAtEveryDepth) {
  for (const BoxFamily& family : kBoxFamilies) {
    for (const int depth : {0, 1, 2, 5, core::kMaxSceneOctreeDepth}) {
      SceneOctree octree(depth);
      for (const std::uint32_t count : {0U, 1U, 2U, 63U, 700U}) {
        const auto seed = count + static_cast<std::uint64_t>(depth) * 1000U;
        const std::string wrong =
            disagreement(make_case(family, count, seed), [&](const BoxCase& c) { return pairs_of(octree, c); });
        ASSERT_EQ(wrong, "") << family.name << ", depth " << depth << ", seed " << seed;
      }
    }
  }
}

// The domain of 4 m at depth 2 has cells of 2 m (level 1) and 1 m (level 2).
TEST(SceneOctree, StoresABodyInTheLowestNodeThatContainsItsBox) {
  SceneOctree octree(2);
  const BoxCase c = dynamic_boxes({
      {{0.25F, 0.25F, 0.25F}, {0.75F, 0.75F, 0.75F}},  // inside a cell of 1 m
      {{0.75F, 0.25F, 0.25F}, {1.25F, 0.75F, 0.75F}},  // across the face x = 1
      {{1.75F, 0.25F, 0.25F}, {2.25F, 0.75F, 0.75F}},  // across the face x = 2
      {{3.75F, 0.25F, 0.25F}, {4.25F, 0.75F, 0.75F}},  // leaves the domain
      {{3.25F, 3.25F, 3.25F}, {4.00F, 4.00F, 4.00F}},  // up to the domain's own corner
  });
  pairs_of(octree, c);
  EXPECT_EQ(octree.nodes()[0].level(), 2);
  EXPECT_EQ(octree.nodes()[1].level(), 1);
  EXPECT_EQ(octree.nodes()[2].level(), 0);
  EXPECT_EQ(octree.nodes()[3].level(), 0);
  EXPECT_EQ(octree.nodes()[4].level(), 2);
}

// E2: one body across a cell face is stored above the body that it overlaps.
TEST(SceneOctree, PrintedE2LosesAPairAcrossLevels) {
  const BoxCase c = dynamic_boxes({
      {{0.75F, 0.25F, 0.25F}, {1.25F, 0.75F, 0.75F}},
      {{1.00F, 0.25F, 0.25F}, {1.50F, 0.75F, 0.75F}},
      {{1.25F, 0.25F, 0.25F}, {1.75F, 0.75F, 0.75F}},
  });
  SceneOctree sound(2);
  SceneOctree printed(2, Variant::kE2);
  EXPECT_EQ(pairs_of(sound, c), (std::vector<Pair>{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_EQ(pairs_of(printed, c), (std::vector<Pair>{{1, 2}}));
}

// The property test's own test: a case that a wrong finder fails shrinks to the two boxes that show it.
TEST(SceneOctree, AFailingCaseShrinksToTwoBoxes) {
  SceneOctree printed(2, Variant::kE2);
  const std::string wrong =
      disagreement(make_case(kBoxFamilies[0], 300, 5), [&](const BoxCase& c) { return pairs_of(printed, c); });
  EXPECT_EQ(wrong.rfind("wrong for these 2 boxes", 0), 0U) << wrong;
}

// E7 builds no level below 1: the pairs stay exact, the octree is shallow.
TEST(SceneOctree, PrintedE7StopsAtLevelOne) {
  SceneOctree printed(2, Variant::kE7);
  const BoxCase c = dynamic_boxes({{{0.25F, 0.25F, 0.25F}, {0.75F, 0.75F, 0.75F}}});
  pairs_of(printed, c);
  EXPECT_EQ(printed.nodes()[0].level(), 1);
  for (const BoxFamily& family : kBoxFamilies)
    ASSERT_EQ(disagreement(make_case(family, 300, 5), [&](const BoxCase& k) { return pairs_of(printed, k); }), "");
}

// METHOD section 2: pruning is what the octree is for. 1000 uniform boxes, 64 cells: far fewer tests than all pairs.
TEST(SceneOctree, TestsFarFewerPairsThanAllPairs) {
  SceneOctree flat(0);
  SceneOctree deep(3);
  BoxCase c;
  Draw draw(1);
  for (int k = 0; k < 1000; ++k)
    c.boxes.push_back(box_at({draw.between(1, 63), draw.between(1, 63), draw.between(1, 63)}, {1, 1, 1}));
  c.is_static.assign(c.boxes.size(), 0);
  c.domain = {{0, 0, 0}, {64, 64, 64}};
  pairs_of(flat, c);
  pairs_of(deep, c);
  EXPECT_EQ(flat.tests(), 1000U * 999U / 2U);
  EXPECT_LT(deep.tests(), flat.tests() / 4U);
}

TEST(SceneOctree, AnyThreadCountGivesTheSameBits) {
  const BoxCase c = make_case(kBoxFamilies[0], 3000, 11);
  std::vector<Pair> first;
  for (const int threads : {1, 2, 3, 8}) {
    auto broad = reference::make_scene_octree_broad_phase(c.domain, 3, Variant::kSound, threads);
    ASSERT_TRUE(broad->load(c.boxes, c.is_static).ok());
    ASSERT_TRUE(broad->find().ok());
    auto set = broad->read_back();
    ASSERT_TRUE(set.ok());
    if (threads == 1) first = set.value().pairs;
    EXPECT_EQ(set.value().pairs, first) << threads << " threads";
    EXPECT_EQ(set.value().demanded, first.size());
  }
  EXPECT_EQ(first, every_pair(c));
}

TEST(SceneOctree, RefusesBoxesThatAreNotFiniteOrInsideOut) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Box& bad : {Box{{0, 0, 0}, {kInf, 1, 1}}, Box{{0, nan, 0}, {1, 1, 1}}, Box{{0, 0, 2}, {1, 1, 1}}}) {
    auto broad = reference::make_scene_octree_broad_phase(core::empty_box());
    const BoxCase c = dynamic_boxes({{{0, 0, 0}, {1, 1, 1}}, bad});
    const core::Status status = broad->load(c.boxes, c.is_static);
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().line().find("box 1"), std::string::npos) << status.error().line();
  }
}

}  // namespace
}  // namespace broadside::tests

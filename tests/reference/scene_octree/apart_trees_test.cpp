// Static boxes in a tree that is kept, moving ones in a tree of each frame: the same pairs as from one tree, and the
// static tree is built again only when a static box changed.
#include "reference/scene_octree/apart_trees.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string_view>
#include <vector>

#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/thin_boxes.hpp"
#include "reference/scene_octree/broad_phases.hpp"
#include "tests/core/engine/counts.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::tests {
namespace {

using core::Box;
using core::Pair;
using reference::ApartTrees;

std::vector<Pair> pairs_of(ApartTrees& trees, const BoxCase& c) {
  std::vector<Pair> pairs;
  trees.start(c.is_static);
  EXPECT_TRUE(trees.build(c.boxes));
  trees.find();
  trees.read_back(pairs);
  return pairs;
}

TEST(ApartTrees, FindsExactlyTheOverlappingPairs) {
  ApartTrees trees;
  for (const BoxFamily& family : kBoxFamilies)
    for (const std::uint32_t count : {0U, 1U, 9U, 65U, 513U, 1500U})
      for (const std::uint32_t static_of_eight : {0U, 1U, 6U, 8U}) {
        BoxCase c = make_case(family, count, 3);
        for (std::uint32_t k = 0; k < count; ++k) c.is_static[k] = k * 2654435761U >> 29U < static_of_eight ? 1 : 0;
        const std::string wrong = disagreement(c, [&](const BoxCase& given) { return pairs_of(trees, given); });
        ASSERT_EQ(wrong, "") << family.name << ", " << count << ", " << static_of_eight << " of 8 static";
      }
}

// Ten frames in which a tenth of 6,000 boxes moves, then a frame in which a static box moves: the change is seen, and
// the pairs are exact.
TEST(ApartTrees, AreBuiltAgainOnlyWhereAStaticBoxChanged) {
  BoxCase c;
  c.boxes = datasets::uniform_boxes(6000, 1);
  c.is_static.assign(c.boxes.size(), 1);
  for (std::size_t k = 0; k < c.boxes.size(); k += 10) c.is_static[k] = 0;
  const auto broad = reference::make_tree_broad_phase(1);
  ASSERT_TRUE(broad->load(c.boxes, c.is_static).ok());
  const auto expect_exact = [&] {
    ASSERT_TRUE(broad->update(c.boxes).ok());
    ASSERT_TRUE(broad->find().ok());
    auto found = broad->read_back();
    ASSERT_TRUE(found.ok());
    EXPECT_EQ(found.value().pairs, every_pair(c));
  };
  for (int frame = 0; frame < 10; ++frame) {
    for (std::size_t k = 0; k < c.boxes.size(); k += 10) c.boxes[k] = core::translated(c.boxes[k], {0.3F, 0.0F, -0.2F});
    expect_exact();
  }
  EXPECT_EQ(counts_of(*broad).at("broad: static trees built"), 1U);
  EXPECT_EQ(counts_of(*broad).at("broad: static boxes kept"), 10U * 5400U);
  c.boxes[1234 + 1] = core::translated(c.boxes[5], {0.1F, 0.1F, 0.1F});
  expect_exact();
  EXPECT_EQ(counts_of(*broad).at("broad: static trees built"), 2U);
  c.boxes[33].max.x = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(broad->update(c.boxes).ok());
}

// The tests of a frame do not grow with static boxes that are far from every moving one: ten times as many static boxes
// add only one more level to the tree.
TEST(ApartTrees, TestsOfAFrameDoNotGrowWithTheStaticWorld) {
  const auto tests_of = [](std::uint32_t static_boxes) {
    BoxCase c;
    c.boxes = datasets::uniform_boxes(1000, 1);
    c.is_static.assign(1000, 0);
    for (const Box& b : datasets::uniform_boxes(static_boxes, 2)) {
      // Outside the moving boxes, which fill a cube of 10.
      c.boxes.push_back(core::translated(b, {9.0F, 0.0F, 0.0F}));
      c.is_static.push_back(1);
    }
    ApartTrees trees;
    pairs_of(trees, c);
    return trees.nodes_visited() + trees.packs_tested();
  };
  EXPECT_LT(static_cast<double>(tests_of(80'000)), 1.3 * static_cast<double>(tests_of(8'000)));
}

TEST(ApartTrees, AreForSetsWithManyStaticBoxes) {
  std::vector<std::uint8_t> is_static(8000, 0);
  EXPECT_FALSE(reference::is_worth_keeping_apart(is_static));
  std::fill_n(is_static.begin(), 1000, std::uint8_t{1});
  EXPECT_TRUE(reference::is_worth_keeping_apart(is_static));
  EXPECT_FALSE(reference::is_worth_keeping_apart(std::vector<std::uint8_t>(100, 1)));
}

}  // namespace
}  // namespace broadside::tests

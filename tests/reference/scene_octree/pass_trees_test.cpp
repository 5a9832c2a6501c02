// Whatever passes a set of boxes is searched in, the pairs are those of trying all, each once; and sets that need
// passes are searched in passes.
#include "reference/scene_octree/pass_trees.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/box_stream.hpp"
#include "datasets/box_streams/thin_boxes.hpp"
#include "datasets/box_streams/uneven_boxes.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::tests {
namespace {

using core::AxisMap;
using core::Box;
using core::Pair;
using reference::PassTrees;

std::vector<Pair> pairs_of(PassTrees& trees, const BoxCase& c) {
  std::vector<Pair> pairs;
  EXPECT_TRUE(trees.build(c.boxes, c.is_static));
  trees.find();
  trees.read_back(pairs);
  return pairs;
}

BoxCase case_of(std::vector<Box> boxes) {
  BoxCase c;
  c.is_static.resize(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); k += 5) c.is_static[k] = 1;
  c.boxes = std::move(boxes);
  return c;
}

TEST(PassTrees, FindsExactlyTheOverlappingPairsOfEveryFamily) {
  PassTrees trees(2);
  int with_passes = 0;
  for (const BoxFamily& family : kBoxFamilies)
    for (const std::uint32_t count : {2U, 9U, 65U, 513U, 1500U})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const std::string wrong =
            disagreement(make_case(family, count, seed), [&](const BoxCase& c) { return pairs_of(trees, c); });
        ASSERT_EQ(wrong, "") << family.name << ", seed " << seed;
        with_passes += trees.plan().is_plain() ? 0 : 1;
      }
  // At least one family, which has 15 cases.
  EXPECT_GE(with_passes, 15) << "else this test says nothing about passes";
}

// Static boxes, three groups, and a second set in the memory of the first.
TEST(PassTrees, FindsExactlyTheOverlappingPairsOfThinAndUnevenBoxes) {
  PassTrees trees(2);
  for (const std::uint32_t count : {3000U, 1500U}) {
    for (const auto make : {datasets::needle_boxes, datasets::sliver_boxes, datasets::exponent_boxes}) {
      const BoxCase c = case_of(make(count, 7));
      EXPECT_EQ(pairs_of(trees, c), every_pair(c));
      EXPECT_EQ(trees.plan().is_plain(), false) << count;
    }
    const BoxCase c = case_of(datasets::uniform_boxes(count, 7));
    EXPECT_EQ(pairs_of(trees, c), every_pair(c));
    EXPECT_TRUE(trees.plan().is_plain());
  }
}

// Needles in a crowd of cubes, plates in two directions, and one box each of kinds that a sample would not contain.
TEST(PassTrees, FindsPairsBetweenGroups) {
  Draw draw(3);
  BoxCase c;
  for (std::uint32_t k = 0; k < 2000; ++k) {
    core::Vec3 sides{0.01F, 0.01F, 0.01F};
    sides[static_cast<int>(k % 3)] = 90.0F;
    if (k % 2 == 0) sides[static_cast<int>((k + 1) % 3)] = 60.0F;
    if (k % 100 == 1) sides = {1.0F, 2.0F, 3.0F};
    if (k == 777) sides = {0.0F, 0.0F, 0.0F};
    c.boxes.push_back(box_at({draw.between(0, 100), draw.between(0, 100), draw.between(0, 100)}, sides));
    c.is_static.push_back(k % 9 == 0 ? 1 : 0);
  }
  PassTrees trees(2);
  EXPECT_EQ(pairs_of(trees, c), every_pair(c));
}

// The kinds of sets that the races use are searched without passes, which would cost them time.
TEST(PassPlan, LeavesUsualSetsAlone) {
  for (const char* spec : {"boxes:uniform:20000", "boxes:heaps:20000", "boxes:mixed:20000", "boxes:line:20000",
                           "boxes:plane:20000", "boxes:flat:20000", "boxes:far:20000", "boxes:spiral:20000",
                           "boxes:cantor:20000", "boxes:sheet:20000", "boxes:mesh:sphere:20", "boxes:touching:20000"}) {
    auto stream = datasets::make_box_stream(spec);
    ASSERT_TRUE(stream.ok());
    EXPECT_TRUE(core::plan_passes(stream.value().boxes).is_plain()) << spec;
  }
}

// 100,000 needles: without passes 2 n^2 / 6 tests; in passes hardly any besides those of sorting.
TEST(PassPlan, GivesNeedlesThreePassesAndALargeGain) {
  const auto plan = core::plan_passes(datasets::needle_boxes(100'000, 1));
  ASSERT_EQ(plan.passes.size(), 3U);
  EXPECT_GT(plan.plain_tests, 1e9);
  EXPECT_LT(plan.pass_tests, 3e7);
  std::uint32_t owned = 0;
  for (const core::BoxPass& pass : plan.passes) {
    EXPECT_EQ(owned & pass.owned, 0U) << "a group has one owner";
    owned |= pass.owned;
  }
  EXPECT_EQ(owned, 7U);
}

// The one property that exactness rests on, at every pattern of bits near which a map changes its formula.
TEST(AxisMap, NeverFalls) {
  std::vector<float> values;
  Draw draw(5);
  for (int k = 0; k < 3000; ++k) values.push_back(draw.finite_float());
  for (const float v : {0.0F, -0.0F, 0x1p-149F, -0x1p-149F, 0x1p-126F, 0x1.fffffep127F, -0x1.fffffep127F, 1.0F})
    values.push_back(v);
  std::sort(values.begin(), values.end());
  const auto one = static_cast<std::int32_t>(std::bit_cast<std::uint32_t>(1.0F));
  for (const AxisMap& map : {AxisMap{false, 0, 1.0F}, AxisMap{false, 0, 0x1p-100F}, AxisMap{false, 0, 0x1p100F},
                             AxisMap{true, 0, 1.0F}, AxisMap{true, one, 0x1p-20F}, AxisMap{true, 0, 0x1p-100F}}) {
    for (std::size_t k = 1; k < values.size(); ++k) {
      ASSERT_LE(map(values[k - 1]), map(values[k])) << values[k];
      ASSERT_TRUE(std::isfinite(map(values[k])));
    }
    EXPECT_EQ(map(0.0F), map(-0.0F));
  }
}

TEST(PassTrees, RefusesBoxesThatAreNotFinite) {
  BoxCase c = case_of(datasets::needle_boxes(3000, 1));
  for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    c.boxes[1234].max.y = bad;
    PassTrees trees(2);
    EXPECT_FALSE(trees.build(c.boxes, c.is_static));
  }
}

}  // namespace
}  // namespace broadside::tests

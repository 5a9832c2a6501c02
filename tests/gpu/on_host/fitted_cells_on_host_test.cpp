// Cells may be larger than the largest box requires. That changes no pair, and it is chosen where it saves tests.
#include <gtest/gtest.h>

#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/box_sweeps.hpp"
#include "datasets/box_streams/uneven_boxes.hpp"
#include "gpu/broad/fitted_cells.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "gpu/broad/searched_boxes.hpp"
#include "gpu/broad/shared_boxes.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::gpu {
namespace {

using core::Box;

PairFinderOptions in_bulk(float cell_scale) {
  PairFinderOptions options;
  options.least_for_grid = 50;
  options.least_for_bulk = 50;
  options.least_for_passes = 1U << 30;
  options.cell_scale = cell_scale;
  return options;
}

// How many box tests finding the pairs takes; `scale` 0: cells are fitted to the boxes.
std::uint64_t tests_with(const tests::BoxCase& c, float scale) {
  PairFinder finder(in_bulk(scale));
  finder.count_work();
  EXPECT_TRUE(finder.load(c.boxes, c.is_static).ok());
  EXPECT_TRUE(finder.find().ok());
  auto found = finder.read_back();
  EXPECT_TRUE(found.ok());
  EXPECT_EQ(found.value().pairs, tests::every_pair(c)) << "scale " << scale;
  std::map<std::string_view, std::uint64_t> counts;
  for (const core::Counter& counter : finder.counters()) counts[counter.name] = counter.count;
  return counts["broad: box tests"];
}

TEST(FittedCellsOnHost, ChangeNoPairOfAnyFamily) {
  for (const tests::BoxFamily& family : tests::kBoxFamilies) {
    SCOPED_TRACE(family.name);
    const tests::BoxCase c = tests::make_case(family, 130, 17);
    for (const float scale : {1.41421356F, 2.82842712F, 3.9F}) tests_with(c, scale);
  }
}

// Cells that are shorter along x, and levels that are farther apart, with one lane a box and with several.
TEST(FittedCellsOnHost, OfEveryShapeChangeNoPairOfAnyFamily) {
  for (const tests::BoxFamily& family : tests::kBoxFamilies) {
    SCOPED_TRACE(family.name);
    const tests::BoxCase c = tests::make_case(family, 130, 23);
    const std::vector<core::Pair> expected = tests::every_pair(c);
    for (const std::uint32_t x_halvings : {1U, 2U}) {
      for (const std::uint32_t levels_apart : {2U, 4U}) {
        PairFinderOptions options = in_bulk(1.0F);
        options.x_halvings = x_halvings;
        options.levels_apart = levels_apart;
        options.lanes_per_box = levels_apart == 2 ? kLanesOfCrowd : 1;
        options.least_for_bins = x_halvings == 1 ? 50 : 1U << 30;
        PairFinder finder(options);
        ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
        ASSERT_TRUE(finder.find().ok());
        auto found = finder.read_back();
        ASSERT_TRUE(found.ok());
        EXPECT_EQ(found.value().pairs, expected) << x_halvings << " halvings, " << levels_apart << " apart";
      }
    }
  }
}

// Sizes over many octaves, with few boxes of each: looking at every level costs more than cells that are too large.
TEST(FittedCellsOnHost, LevelsAreFartherApartWhereRowsOfCellsAreNearlyEmpty) {
  using Make = std::vector<Box> (*)(std::uint32_t, std::uint64_t);
  const std::pair<Make, std::uint32_t> sets[] = {
      {datasets::spiral_boxes, 4}, {datasets::mixed_boxes, 2}, {datasets::uniform_boxes, 2}};
  for (const auto& [make, apart] : sets) {
    FactsOfBoxes facts;
    const std::vector<Box> boxes = make(100'000, 1);
    for (const Box& box : boxes) facts.add(box);
    EXPECT_EQ(bulk_fit(boxes, facts.all()).levels_apart, apart);
  }
}

// Boxes a little longer than a quarter of the largest one are nearly four times shorter than their cells.
TEST(FittedCellsOnHost, SaveTestsWhereMostBoxesAreMuchShorterThanTheirCells) {
  tests::Draw draw(3);
  tests::BoxCase c;
  for (int k = 0; k < 2500; ++k) {
    const float s = k == 0 ? 1.0F : 0.27F;
    c.boxes.push_back(tests::box_at({draw.between(0, 4), draw.between(0, 4), draw.between(0, 1)}, {s, s, s}));
  }
  c.is_static.resize(c.boxes.size());
  const std::uint64_t fitted = tests_with(c, 0.0F);
  EXPECT_LT(2 * fitted, tests_with(c, 1.0F));
}

TEST(FittedCellsOnHost, AreTheLargestBoxsWhereThatIsBest) {
  for (const auto make : {datasets::uniform_boxes, datasets::heap_boxes}) {
    FactsOfBoxes facts;
    const std::vector<Box> boxes = make(20'000, 1);
    for (const Box& box : boxes) facts.add(box);
    EXPECT_EQ(bulk_fit(boxes, facts.all()).cell_scale, 1.0F);
    EXPECT_EQ(bulk_fit(boxes, facts.all()).lanes_per_box, 1U);
  }
  EXPECT_EQ(bulk_fit({}, {}).cell_scale, 1.0F);
}

// A sample of a thousand of a million boxes has no neighbors in it, but the thousand have some in a larger sample.
// Boxes whose cells hold many others on one level get four lanes. With sizes over three orders a box meets as many
// others, but few on each level.
TEST(FittedCellsOnHost, FourLanesWhereRowsOfCellsAreLong) {
  FactsOfBoxes crowded;
  FactsOfBoxes mixed;
  const std::vector<Box> crowd = datasets::boxes_of_density(20'000, 1, 4.0);
  const std::vector<Box> sizes = datasets::mixed_boxes(100'000, 1);
  for (const Box& box : crowd) crowded.add(box);
  for (const Box& box : sizes) mixed.add(box);
  EXPECT_EQ(bulk_fit(crowd, crowded.all()).lanes_per_box, kLanesOfCrowd);
  EXPECT_EQ(bulk_fit(sizes, mixed.all()).lanes_per_box, 1U);
}

// The search by groups is chosen where a box has far more others in its cells than partners.
TEST(FittedCellsOnHost, GroupsWhereCellsAreFull) {
  const auto is_grouped = [](const std::vector<Box>& boxes) {
    FactsOfBoxes facts;
    for (const Box& box : boxes) facts.add(box);
    return bulk_fit(boxes, facts.all()).is_grouped;
  };
  EXPECT_TRUE(is_grouped(datasets::mixed_boxes(100'000, 1)));
  EXPECT_FALSE(is_grouped(datasets::uniform_boxes(100'000, 1)));
  EXPECT_FALSE(is_grouped(datasets::heap_boxes(100'000, 1)));
  EXPECT_FALSE(is_grouped(datasets::uniform_boxes(2'000'000, 1))) << "by another sample";
}

TEST(FittedCellsOnHost, AreFoundOutOfAMillionBoxesToo) {
  constexpr std::uint32_t kMany = 1'100'000;
  FactsOfBoxes facts;
  std::vector<Box> boxes = datasets::uniform_boxes(kMany, 1);
  for (const Box& box : boxes) facts.add(box);
  EXPECT_EQ(bulk_fit(boxes, facts.all()).cell_scale, 1.0F);
  // Boxes around the origin, nearly four times shorter than the largest one.
  tests::Draw draw(3);
  boxes.clear();
  for (std::uint32_t k = 0; k < kMany; ++k) {
    const float s = k == 0 ? 1.0F : 0.27F;
    boxes.push_back(tests::box_at({draw.between(-19, 19), draw.between(-19, 19), draw.between(-19, 19)}, {s, s, s}));
  }
  facts = {};
  for (const Box& box : boxes) facts.add(box);
  const BulkFit fit = bulk_fit(boxes, facts.all());
  EXPECT_EQ(fit.cell_scale, 1.41421356F);
  EXPECT_EQ(fit.lanes_per_box, 1U) << "there are enough boxes for all lanes";
}

// A crowd in a world that is 200,000 times as wide as a box. Once, cells were made half as large again as the boxes,
// only because of the large coordinates; and for a crowd far from the origin few bits are left to say where a box is.
TEST(FittedCellsOnHost, AreNoLargerInAWideWorld) {
  constexpr float kFar = 200'000.0F;
  for (const float at : {0.0F, kFar}) {
    tests::Draw draw(4);
    tests::BoxCase c;
    for (int k = 0; k < 1200; ++k)
      c.boxes.push_back(tests::box_at({at + draw.between(0, 11), draw.between(0, 11), draw.between(0, 11)},
                                      {draw.between(0.8F, 1.1F), draw.between(0.8F, 1.1F), draw.between(0.8F, 1.1F)}));
    tests::BoxCase alone = c;
    alone.is_static.resize(alone.boxes.size());
    for (const float stray : {-kFar, 0.5F * kFar, kFar - 2.0F})
      c.boxes.push_back(tests::box_at({stray, -stray, 0.25F * stray}, {1.0F, 1.0F, 1.0F}));
    c.is_static.resize(c.boxes.size());
    if (at == 0.0F) {
      EXPECT_LT(tests_with(c, 1.0F), tests_with(alone, 1.0F) * 11 / 10);
    }
    tests_with(c, 1.41421356F);
  }
}

}  // namespace
}  // namespace broadside::gpu

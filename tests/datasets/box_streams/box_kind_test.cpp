// The figures that say what kind of set some boxes are, on sets for which they follow from the definition.
#include "datasets/box_streams/box_kind.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/degenerate_boxes.hpp"
#include "datasets/box_streams/thin_boxes.hpp"

namespace broadside {
namespace {

using core::Box;
using datasets::BoxKind;
using datasets::kind_of;

TEST(BoxKind, OfEqualCubesOnALattice) {
  const BoxKind kind = kind_of(datasets::touching_boxes(16 * 16 * 16));
  EXPECT_EQ(kind.boxes, 4096U);
  EXPECT_EQ(kind.least_m, 1.0);
  EXPECT_EQ(kind.most_m, 1.0);
  EXPECT_EQ(kind.size_ratio(), 1.0);
  EXPECT_EQ(kind.flatness, 1.0);
  EXPECT_EQ(kind.thin_share, 0.0);
  // Eight boxes a cell in each of 8^3 cells: half of the boxes are in half of the cells, except for cells that the
  // lattice cuts.
  EXPECT_NEAR(kind.cells_of_half, 0.5, 0.15);
}

TEST(BoxKind, OfThinBoxes) {
  const BoxKind kind = kind_of(datasets::needle_boxes(5000, 1));
  EXPECT_EQ(kind.thin_share, 1.0);
  EXPECT_LT(kind.flatness, 2e-6);
}

TEST(BoxKind, OfSizesFromOneToAThousand) {
  const BoxKind kind = kind_of(datasets::mixed_boxes(20'000, 1));
  // The one of 1000 has a side of 800 to 1200; others have 0.8 to 1.2 of at least 1.
  EXPECT_GT(kind.most_m, 800.0);
  EXPECT_LT(kind.least_m, 1.2);
  EXPECT_GT(kind.size_ratio(), 800.0 / 1.2);
}

// The boxes of heaps lie in a corner that is a sixty-fourth as wide as the world.
TEST(BoxKind, OfClustersAndOfNone) {
  const double even = kind_of(datasets::uniform_boxes(20'000, 1)).cells_of_half;
  // Of cells with 8 boxes on average, the fullest that hold half: some 0.38 of a Poisson distribution.
  EXPECT_NEAR(even, 0.38, 0.05);
  EXPECT_LT(kind_of(datasets::heap_boxes(20'000, 1)).cells_of_half, even / 20.0);
}

TEST(BoxKind, OfPointsAtOnePlaceAndOfNoBoxes) {
  const BoxKind points = kind_of(std::vector<Box>(100, Box{{1, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(points.size_ratio(), 1.0);
  EXPECT_EQ(points.cells_of_half, 1.0);
  EXPECT_NE(words_of(points, 49.5).find("half of all boxes in 100 % of"), std::string::npos) << words_of(points, 49.5);
  EXPECT_EQ(points.thin_share, 0.0);
  EXPECT_EQ(kind_of({}).boxes, 0U);
  const std::vector<Box> one_point{{{0, 0, 0}, {0, 0, 0}}, {{1, 1, 1}, {2, 2, 2}}};
  EXPECT_TRUE(std::isinf(kind_of(one_point).size_ratio()));
}

}  // namespace
}  // namespace broadside

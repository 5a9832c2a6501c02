// Static and moving boxes apart on the GPU, with the kernels' threads on the host: the pairs are those of trying all,
// and the static table is built once for as long as its boxes rest.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/box_streams/box_sets.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "tests/core/engine/counts.hpp"
#include "tests/gpu/on_host/found_pairs.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Pair;

PairFinderOptions apart_from(std::uint32_t boxes, std::uint32_t least_for_bins = 1U << 30) {
  PairFinderOptions options;
  options.least_for_grid = 50;
  options.least_for_bins = least_for_bins;
  options.least_for_apart = boxes;
  return options;
}

bool is_apart(const PairFinder& finder) {
  return finder.path().starts_with("static boxes in a table that is kept");
}

// Every second box is static; with the other value of `first`, static and moving boxes change places.
tests::BoxCase half_static(tests::BoxCase c, std::size_t first) {
  for (std::size_t k = 0; k < c.is_static.size(); ++k) c.is_static[k] = k % 2 == first ? 1 : 0;
  return c;
}

// Where the ids of moving boxes follow each other, they are counted from the first one's id; otherwise each is looked
// up.
TEST(ApartOnHost, MovingBoxesBehindOrBeforeTheStaticOnes) {
  for (const bool are_static_first : {false, true}) {
    tests::BoxCase c;
    c.boxes = datasets::uniform_boxes(400, 8);
    c.is_static.assign(400, are_static_first ? 0 : 1);
    for (std::size_t k = 0; k < 150; ++k) c.is_static[k] = are_static_first ? 1 : 0;
    PairFinder finder(apart_from(50));
    ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
    ASSERT_TRUE(is_apart(finder));
    EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
  }
}

TEST(ApartOnHost, EveryFamily) {
  int apart = 0;
  for (const tests::BoxFamily& family : tests::kBoxFamilies) {
    SCOPED_TRACE(family.name);
    for (const std::size_t first : {0U, 1U}) {
      const tests::BoxCase c = half_static(tests::make_case(family, 140, 21), first);
      for (const std::uint32_t least_for_bins : {1U << 30, 50U}) {
        PairFinder finder(apart_from(50, least_for_bins));
        ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
        EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
        apart += is_apart(finder) ? 1 : 0;
      }
    }
  }
  EXPECT_GE(apart, 32) << "at least eight families, both ways";
}

// Moving boxes up to forty times as long as static ones, and as many times shorter.
TEST(ApartOnHost, MovingBoxesOfOtherSizesThanStaticOnes) {
  for (const float size : {0.02F, 0.3F, 3.0F, 40.0F}) {
    SCOPED_TRACE(size);
    tests::Draw draw(5);
    tests::BoxCase c;
    for (int k = 0; k < 130; ++k) {
      const float s = k % 3 == 0 ? size : 1.0F;
      c.boxes.push_back(tests::box_at({draw.between(0, 30), draw.between(0, 30), draw.between(0, 8)},
                                      {s * draw.between(0.8F, 1), s * draw.between(0.1F, 1), s * draw.between(0, 1)}));
      c.is_static.push_back(k % 3 == 0 ? 0 : 1);
    }
    PairFinder finder(apart_from(50));
    ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
    EXPECT_TRUE(is_apart(finder));
    EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
  }
}

// A moving box a thousand times longer than the static ones would look at a million cells: all are searched together.
TEST(ApartOnHost, AGiantAmongCrumbsIsSearchedTogether) {
  tests::BoxCase c;
  c.boxes = datasets::uniform_boxes(200, 3);
  c.is_static.assign(200, 1);
  c.is_static[7] = 0;
  c.boxes[7] = {{-500, -500, -500}, {500, 500, 500}};
  PairFinder finder(apart_from(50));
  ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
  EXPECT_FALSE(is_apart(finder));
  EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
}

TEST(ApartOnHost, TheStaticTableIsKeptWhileItsBoxesRest) {
  tests::BoxCase c = half_static({datasets::uniform_boxes(300, 6), std::vector<std::uint8_t>(300), {}}, 0);
  PairFinder finder(apart_from(50));
  ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
  for (int frame = 0; frame < 4; ++frame) {
    EXPECT_EQ(pairs_of(finder), tests::every_pair(c)) << "frame " << frame;
    for (std::size_t k = 1; k < 300; k += 2) c.boxes[k] = core::translated(c.boxes[k], {0.3F, -0.2F, 0.1F});
    if (frame == 2) c.boxes[10] = core::translated(c.boxes[10], {1.0F, 0.0F, 0.0F});
    ASSERT_TRUE(finder.update(c.boxes).ok());
  }
  EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
  auto counts = tests::counts_of(finder);
  EXPECT_EQ(counts["broad: static tables built"], 2U) << "one box of it moved in the third update";
  EXPECT_EQ(counts["broad: static boxes kept"], 3U * 150U);
  // Both builds of the static table, and the moving boxes of each update.
  EXPECT_EQ(counts["bytes to the device"], (2U * 150U + 5U * 150U) * 32U);
}

// Coarse cells show which moving boxes are near no static one. The cells are as large as the largest box of the first
// frame; boxes that grow, or that lie around and below the origin, are found all the same.
TEST(ApartOnHost, MovingBoxesOnBothSidesOfTheOriginThatGrow) {
  tests::Draw draw(8);
  tests::BoxCase c;
  for (int k = 0; k < 260; ++k) {
    const bool stands = k % 2 == 0;
    c.boxes.push_back(tests::box_at({draw.between(-60, 60), draw.between(-4, 4), draw.between(-4, 4)},
                                    {draw.between(0.2F, 1), draw.between(0.2F, 1), draw.between(0.2F, 1)}));
    c.is_static.push_back(stands ? 1 : 0);
  }
  PairFinder finder(apart_from(50));
  ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
  for (const float size : {1.0F, 3.0F, 9.0F}) {
    for (std::size_t k = 1; k < c.boxes.size(); k += 2) {
      const core::Vec3 side = c.boxes[k].max - c.boxes[k].min;
      c.boxes[k].max = c.boxes[k].min + core::Vec3{size * side.x, side.y, side.z};
    }
    ASSERT_TRUE(finder.update(c.boxes).ok());
    EXPECT_TRUE(is_apart(finder));
    EXPECT_EQ(pairs_of(finder), tests::every_pair(c)) << size;
  }
}

TEST(ApartOnHost, FewStaticBoxesAreSearchedTogether) {
  tests::BoxCase c;
  c.boxes = datasets::uniform_boxes(200, 3);
  c.is_static.assign(200, 0);
  for (int k = 0; k < 20; ++k) c.is_static[static_cast<std::size_t>(k)] = 1;
  PairFinder finder(apart_from(50));
  ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
  EXPECT_FALSE(is_apart(finder));
  EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
}

}  // namespace
}  // namespace broadside::gpu

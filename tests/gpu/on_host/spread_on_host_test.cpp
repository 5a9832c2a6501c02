// A set that is spread over devices, which here are three of the host: the pairs are those of trying all, each once,
// for any number of parts and devices.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/pair.hpp"
#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/thin_boxes.hpp"
#include "gpu/broad/dealt_boxes.hpp"
#include "gpu/broad/spread_finder.hpp"
#include "tests/gpu/on_host/found_pairs.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Pair;

// Longer than 2^125 m, as some boxes of "any bits" are.
bool has_endless_box(const tests::BoxCase& c) {
  return std::any_of(c.boxes.begin(), c.boxes.end(), [](const Box& b) {
    const core::Vec3 side = b.max - b.min;
    return !(std::max({side.x, side.y, side.z}) < 0x1p124F);
  });
}

TEST(SpreadOnHost, EveryFamilyInAnyNumberOfParts) {
  int families = 0;
  for (const tests::BoxFamily& family : tests::kBoxFamilies) {
    SCOPED_TRACE(family.name);
    const tests::BoxCase c = tests::make_case(family, 120, 5);
    if (has_endless_box(c)) continue;
    ++families;
    const std::vector<Pair> expected = tests::every_pair(c);
    for (const std::uint32_t parts : {1U, 2U, 3U, 8U}) {
      SpreadFinder finder({parts, parts == 2 ? 1U : 3U});
      ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
      EXPECT_EQ(pairs_of(finder), expected) << parts << " parts";
    }
  }
  EXPECT_GE(families, 10);
}

TEST(SpreadOnHost, DigestIsThatOfOneDeviceWhereBoxesComePartByPart) {
  std::vector<Box> boxes = datasets::uniform_boxes(500, 3);
  const core::SpaceCut cut = core::cut_space(boxes, 3);
  std::stable_sort(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    return cut.part_at(a.min[cut.axis]) < cut.part_at(b.min[cut.axis]);
  });
  const std::vector<std::uint8_t> is_static(boxes.size());
  SpreadFinder one({1, 1});
  SpreadFinder three({3, 3});
  ASSERT_TRUE(one.load(boxes, is_static).ok());
  ASSERT_TRUE(three.load_cut(boxes, is_static, cut).ok());
  const std::vector<Pair> expected = pairs_of(one);
  EXPECT_EQ(pairs_of(three), expected);
  auto of_one = one.digest();
  auto of_three = three.digest();
  ASSERT_TRUE(of_one.ok() && of_three.ok());
  EXPECT_EQ(of_one.value(), core::pair_digest(expected));
  EXPECT_EQ(of_three.value(), of_one.value());
}

// Every box begins in the first part and reaches into two more: there are more guests than borders first have room for.
TEST(SpreadOnHost, NeedlesReachIntoEveryPart) {
  tests::BoxCase c;
  c.boxes = datasets::needle_boxes(1500, 2);
  for (std::size_t k = 0; k < c.boxes.size(); ++k) {
    c.boxes[k].min.x = 0.01F * static_cast<float>(k % 90);
    c.boxes[k].max.x = 50.0F;
  }
  c.is_static.resize(c.boxes.size());
  core::SpaceCut cut{0, {1.0F, 2.0F, 60.0F}};
  SpreadFinder finder({4, 2});
  ASSERT_TRUE(finder.load_cut(c.boxes, c.is_static, cut).ok());
  EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
  EXPECT_EQ(finder.counters()[0].count, 2U * 1500U * 32U);
}

TEST(SpreadOnHost, BoxesMoveFromPartToPart) {
  tests::BoxCase c;
  c.boxes = datasets::uniform_boxes(300, 1);
  c.is_static.resize(300);
  for (std::size_t k = 0; k < 300; k += 5) c.is_static[k] = 1;
  SpreadFinder finder({3, 3});
  ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
  for (int frame = 0; frame < 3; ++frame) {
    for (Box& b : c.boxes) std::swap(b.min.x, b.min.y), std::swap(b.max.x, b.max.y);
    for (Box& b : c.boxes) b = core::translated(b, {frame * 0.75F, 0.0F, 0.0F});
    ASSERT_TRUE(finder.update(c.boxes).ok());
    EXPECT_EQ(pairs_of(finder), tests::every_pair(c)) << "frame " << frame;
  }
}

TEST(SpreadOnHost, CountsTheBytesThatBordersNeed) {
  // Two of five boxes reach over the one face.
  const std::vector<Box> boxes{{{0, 0, 0}, {1, 1, 1}},
                               {{0, 0, 0}, {2, 1, 1}},
                               {{1, 0, 0}, {3, 1, 1}},
                               {{2, 0, 0}, {3, 1, 1}},
                               {{5, 0, 0}, {6, 1, 1}}};
  SpreadFinder finder({2, 2});
  ASSERT_TRUE(finder.load_cut(boxes, std::vector<std::uint8_t>(5), {0, {2.0F}}).ok());
  EXPECT_EQ(pairs_of(finder).size(), 5U);
  EXPECT_EQ(finder.counters()[0].count, 2U * 32U);
  EXPECT_EQ(finder.counters()[1].count, 2U * 28U);
}

TEST(SpreadOnHost, RefusesWhatCannotBe) {
  const std::vector<Box> boxes(3, Box{{0, 0, 0}, {1, 1, 1}});
  const std::vector<std::uint8_t> is_static(3);
  SpreadFinder many({4, 4});
  const core::Status too_many = many.load(boxes, is_static);
  ASSERT_FALSE(too_many.ok());
  EXPECT_NE(too_many.error().line().find("4 devices are asked for, and there are 3"), std::string::npos);
  SpreadFinder finder({2, 2});
  std::vector<Box> bad = boxes;
  bad[2].max.y = std::numeric_limits<float>::quiet_NaN();
  const core::Status status = finder.load(bad, is_static);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().line().find("box 2"), std::string::npos);
  EXPECT_FALSE(check_box_limit(kMostBoxes + 1).ok());
  EXPECT_TRUE(check_box_limit(kMostBoxes).ok());
}

}  // namespace
}  // namespace broadside::gpu

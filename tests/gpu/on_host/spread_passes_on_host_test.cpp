// A set that is spread over devices, which here are three of the host, in passes and in chunks: long thin boxes, worlds
// over all exponents, and little room for pairs. The pairs are those of trying all, each once.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/pair.hpp"
#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/thin_boxes.hpp"
#include "datasets/box_streams/uneven_boxes.hpp"
#include "gpu/broad/spread_finder.hpp"
#include "tests/gpu/on_host/found_pairs.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Pair;

constexpr std::uint32_t kParts[] = {1, 2, 3, 8};

SpreadOptions spread_over(std::uint32_t parts, std::uint64_t pairs_at_once = 0) {
  return {parts, parts == 2 ? 1U : 3U, pairs_at_once, 50};
}

TEST(SpreadPassesOnHost, ThinAndUnevenBoxesInAnyNumberOfParts) {
  for (const auto make : {datasets::needle_boxes, datasets::exponent_boxes, datasets::sliver_boxes}) {
    const tests::BoxCase c = case_of(make(700, 5));
    const std::vector<Pair> expected = tests::every_pair(c);
    for (const std::uint32_t parts : kParts) {
      SpreadFinder finder(spread_over(parts));
      ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
      EXPECT_FALSE(finder.plan().is_plain());
      EXPECT_NE(finder.path().find("passes"), std::string::npos) << finder.path();
      EXPECT_EQ(pairs_of(finder), expected) << parts << " parts";
      auto digest = finder.digest();
      ASSERT_TRUE(digest.ok());
      EXPECT_EQ(digest.value(), core::pair_digest(expected)) << parts << " parts";
      EXPECT_EQ(handed_on(finder).pairs, expected) << parts << " parts";
    }
  }
}

TEST(SpreadPassesOnHost, OfEveryFamilyInASmallRoom) {
  int families = 0;
  for (const tests::BoxFamily& family : tests::kBoxFamilies) {
    SCOPED_TRACE(family.name);
    const tests::BoxCase c = tests::make_case(family, 110, 9);
    SpreadFinder finder(spread_over(3, 120));
    if (!finder.load(c.boxes, c.is_static).ok() || !finder.find().ok()) continue;  // boxes longer than 2^125 m
    ++families;
    EXPECT_EQ(pairs_of(finder), tests::every_pair(c));
  }
  EXPECT_GE(families, 10);
}

TEST(SpreadPassesOnHost, ChunksAreNoLargerThanAsked) {
  for (const auto make : {datasets::uniform_boxes, datasets::sliver_boxes}) {
    const tests::BoxCase c = case_of(make(900, 4));
    const std::vector<Pair> expected = tests::every_pair(c);
    for (const std::uint32_t parts : kParts) {
      SpreadFinder finder(spread_over(parts, 200));
      ASSERT_TRUE(finder.load(c.boxes, c.is_static).ok());
      const Chunks found = handed_on(finder);
      EXPECT_EQ(found.pairs, expected) << parts << " parts";
      EXPECT_LE(found.largest, 200U);
      EXPECT_GE(found.count, expected.size() / 200);
      EXPECT_EQ(pairs_of(finder), expected) << parts << " parts";
      EXPECT_FALSE(finder.digest().ok());
    }
  }
}

// From thin boxes to even ones and back: each search uses the memory that another kind of search left.
TEST(SpreadPassesOnHost, UpdatesFromOnePlanToAnother) {
  const tests::BoxCase even = case_of(datasets::uniform_boxes(500, 1));
  const tests::BoxCase thin = case_of(datasets::needle_boxes(500, 1));
  SpreadFinder finder(spread_over(3));
  ASSERT_TRUE(finder.load(even.boxes, even.is_static).ok());
  for (const tests::BoxCase* c : {&thin, &even, &thin}) {
    ASSERT_TRUE(finder.update(c->boxes).ok());
    EXPECT_EQ(finder.plan().is_plain(), c == &even);
    EXPECT_EQ(pairs_of(finder), tests::every_pair(*c));
    EXPECT_EQ(handed_on(finder).pairs, tests::every_pair(*c)) << "after a search that stores its pairs";
  }
}

TEST(SpreadPassesOnHost, ABoxWithMorePairsThanARoomIsAnErrorWithTheNumber) {
  const std::vector<Box> boxes(150, Box{{0, 0, 0}, {1, 1, 1}});
  SpreadFinder finder(spread_over(2, 100));
  ASSERT_TRUE(finder.load(boxes, std::vector<std::uint8_t>(150)).ok());
  const core::Status status = finder.find();
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().line().find("one box alone has 149 pairs, and a chunk has room for 100"), std::string::npos)
      << status.error().line();
}

TEST(SpreadPassesOnHost, AConsumerMayEndTheSearch) {
  SpreadFinder finder(spread_over(3, 100));
  const std::vector<Box> boxes = datasets::uniform_boxes(400, 1);
  ASSERT_TRUE(finder.load(boxes, std::vector<std::uint8_t>(400)).ok());
  int taken = 0;
  const core::Status status = finder.hand_on([&](const core::DevicePairs&) -> core::Status {
    if (++taken == 2) return core::Error{"that is enough"};
    return core::Done{};
  });
  EXPECT_FALSE(status.ok());
  EXPECT_EQ(taken, 2);
}

}  // namespace
}  // namespace broadside::gpu

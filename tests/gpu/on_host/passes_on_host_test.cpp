// The GPU's broad phase in passes, with the kernels' threads on the host: the pairs are those of trying all, each once,
// and a search makes fewer tests where passes were chosen for that.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "datasets/box_streams/box_sets.hpp"
#include "datasets/box_streams/thin_boxes.hpp"
#include "datasets/box_streams/uneven_boxes.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "tests/gpu/on_host/found_pairs.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Pair;

constexpr std::uint32_t kBeyondAll = 1U << 30;

PairFinderOptions passes_from(std::uint32_t boxes, std::uint32_t bulk, std::uint32_t bins) {
  PairFinderOptions options;
  options.least_for_grid = 50;
  options.least_for_bulk = bulk;
  options.least_for_bins = bins;
  options.least_for_passes = boxes;
  return options;
}

std::vector<Pair> pairs_of(PairFinder& finder, const tests::BoxCase& c) {
  EXPECT_TRUE(finder.load(c.boxes, c.is_static).ok());
  EXPECT_TRUE(finder.find().ok());
  auto found = finder.read_back();
  EXPECT_TRUE(found.ok());
  return std::move(found.value().pairs);
}

TEST(PassesOnHost, EveryFamilyInEachSearch) {
  int with_passes = 0;
  for (const tests::BoxFamily& family : tests::kBoxFamilies) {
    SCOPED_TRACE(family.name);
    const tests::BoxCase c = tests::make_case(family, 130, 11);
    for (const auto& options :
         {passes_from(50, kBeyondAll, kBeyondAll), passes_from(50, 50, kBeyondAll), passes_from(50, 50, 50)}) {
      PairFinder finder(options);
      EXPECT_EQ(pairs_of(finder, c), tests::every_pair(c));
      with_passes += finder.plan().is_plain() ? 0 : 1;
    }
  }
  EXPECT_GE(with_passes, 3) << "one family, at least, in three searches";
}

// One finder for all sets: each has another number of passes or fewer boxes, in the memory that the set before left.
TEST(PassesOnHost, ThinAndUnevenBoxesInTheMemoryOfOthers) {
  PairFinder finder(passes_from(50, 200, kBeyondAll));
  for (const std::uint32_t count : {900U, 200U}) {
    for (const auto make :
         {datasets::needle_boxes, datasets::exponent_boxes, datasets::sliver_boxes, datasets::uniform_boxes}) {
      const tests::BoxCase c = case_of(make(count, 5));
      EXPECT_EQ(pairs_of(finder, c), tests::every_pair(c));
      // For 200 boxes, sorting them into passes would take longer than testing them.
      if (count == 900U) {
        EXPECT_EQ(finder.plan().is_plain(), make == datasets::uniform_boxes);
      }
    }
  }
}

// update() with boxes that need passes where those of load() did not, and back.
TEST(PassesOnHost, UpdatesFromOnePlanToAnother) {
  PairFinder finder(passes_from(50, kBeyondAll, kBeyondAll));
  const tests::BoxCase even = case_of(datasets::uniform_boxes(400, 1));
  const tests::BoxCase thin = case_of(datasets::needle_boxes(400, 1));
  ASSERT_TRUE(finder.load(even.boxes, even.is_static).ok());
  for (const tests::BoxCase* c : {&thin, &even, &thin}) {
    ASSERT_TRUE(finder.update(c->boxes).ok());
    ASSERT_TRUE(finder.find().ok());
    auto found = finder.read_back();
    ASSERT_TRUE(found.ok());
    EXPECT_EQ(found.value().pairs, tests::every_pair(*c));
  }
}

// One pass finds more pairs than there is room for: it is run again, and no pair is lost or doubled.
TEST(PassesOnHost, GrowsWhereAPassFindsMoreThanExpected) {
  std::vector<Box> boxes = datasets::needle_boxes(600, 3);
  for (std::size_t k = 0; k < 200; ++k) boxes[3 * k] = boxes[0];
  const tests::BoxCase c = case_of(boxes);
  PairFinder finder(passes_from(50, kBeyondAll, kBeyondAll));
  EXPECT_EQ(pairs_of(finder, c), tests::every_pair(c));
}

// Each pass leaves its pairs in an array of its own; a caller that asks for all pairs gets one array.
TEST(PassesOnHost, PairsOfAllPassesLieTogetherOnTheDevice) {
  const tests::BoxCase c = case_of(datasets::needle_boxes(500, 2));
  PairFinder finder(passes_from(50, kBeyondAll, kBeyondAll));
  const std::vector<Pair> expected = pairs_of(finder, c);
  ASSERT_GT(finder.plan().passes.size(), 1U);
  auto lying = finder.pairs_on_device();
  ASSERT_TRUE(lying.ok());
  std::vector<Pair> found(lying.value().data, lying.value().data + lying.value().count);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
}

std::uint64_t tests_of(const std::vector<Box>& boxes, bool has_passes) {
  PairFinder finder(passes_from(has_passes ? 50 : kBeyondAll, kBeyondAll, kBeyondAll));
  finder.count_work();
  pairs_of(finder, case_of(boxes));
  EXPECT_EQ(finder.plan().is_plain(), !has_passes);
  std::map<std::string_view, std::uint64_t> counts;
  for (const core::Counter& counter : finder.counters()) counts[counter.name] = counter.count;
  return counts["broad: box tests"];
}

// Without passes, needles are tested all against all: n (n - 1) / 2. In three passes each is tested against those that
// share its cell in the coordinates of the pass, which is hardly any, and against those whose cells share a bucket of
// the table with it: some 15 buckets of two thirds of a box.
TEST(PassesOnHost, NeedlesAreTestedAgainstFew) {
  constexpr std::uint64_t kCount = 600;
  const std::vector<Box> boxes = datasets::needle_boxes(kCount, 3);
  EXPECT_GT(tests_of(boxes, false), kCount * (kCount - 1) / 4);
  EXPECT_LT(tests_of(boxes, true), 50 * kCount);
}

// Without passes, nearly all of them are in the finest cells around the origin.
TEST(PassesOnHost, BoxesOverAllExponentsAreTestedAgainstFew) {
  const std::vector<Box> boxes = datasets::exponent_boxes(350, 3);
  EXPECT_LT(3 * tests_of(boxes, true), tests_of(boxes, false));
}

}  // namespace
}  // namespace broadside::gpu

// Boxes in device memory are packed and measured there, and give the pairs that boxes in host memory give. Here the
// device is the host.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "datasets/box_streams/thin_boxes.hpp"
#include "gpu/broad/pack_view.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Pair;

std::vector<Box> boxes_of(std::uint32_t count, float spread_m, std::uint32_t seed) {
  std::vector<Box> boxes;
  Dice dice(seed);
  for (std::uint32_t i = 0; i < count; ++i) {
    const core::Vec3 center = dice.cube(spread_m);
    const core::Vec3 half{0.25F + 0.5F * dice.next(), 0.25F + 0.5F * dice.next(), 0.25F + 0.5F * dice.next()};
    boxes.push_back({center - half, center + half});
  }
  return boxes;
}

std::vector<std::uint8_t> some_static(std::size_t count) {
  std::vector<std::uint8_t> flags(count);
  for (std::size_t i = 0; i < count; i += 7) flags[i] = 1;
  return flags;
}

core::DeviceBoxes lying(const std::vector<Box>& boxes) {
  return {reinterpret_cast<const float*>(boxes.data()), boxes.size()};
}

std::vector<Pair> overlapping(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& is_static) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (core::overlaps(boxes[i], boxes[j]) && (is_static[i] == 0 || is_static[j] == 0)) pairs.push_back({i, j});
  return pairs;
}

std::vector<Pair> found_by(PairFinder& finder) {
  EXPECT_TRUE(finder.find().ok());
  auto rows = finder.pairs_on_device();
  EXPECT_TRUE(rows.ok());
  auto set = finder.read_back();
  EXPECT_TRUE(set.ok());
  EXPECT_EQ(set.value().pairs.size(), rows.value().count);
  std::vector<Pair> there(rows.value().data, rows.value().data + rows.value().count);
  std::sort(there.begin(), there.end());
  EXPECT_TRUE(there == set.value().pairs) << "what lies on the device is what is read back";
  return set.value().pairs;
}

// Tiles, the grid, and the search in bulk.
PairFinderOptions starting_at(std::uint32_t grid, std::uint32_t bulk) {
  return {Broad::kTree, core::Variant::kSound, 0.5F, grid, bulk, 1U << 30};
}

TEST(DeviceBoxesOnHost, GiveTheOverlappingPairs) {
  for (const PairFinderOptions& options :
       {starting_at(1U << 30, 1U << 30), starting_at(50, 1U << 30), starting_at(50, 50)}) {
    PairFinder finder(options);
    const auto flags = some_static(300);
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      // The third set is far away and wider: it uses other cells, in the tables that the second set left.
      std::vector<Box> boxes = boxes_of(300, seed == 3 ? 24.0F : 12.0F, seed);
      for (Box& box : boxes)
        if (seed == 3) box = core::translated(box, {1000.0F, -500.0F, 0.0F});
      ASSERT_TRUE(
          (seed == 1 ? finder.load_on_device(lying(boxes), flags) : finder.update_on_device(lying(boxes))).ok());
      const std::vector<Pair> expected = overlapping(boxes, flags);
      EXPECT_TRUE(found_by(finder) == expected) << "seed " << seed;
      EXPECT_GT(expected.size(), 5U);
    }
  }
}

TEST(DeviceBoxesOnHost, TakeTurnsWithBoxesOfTheHost) {
  const auto flags = some_static(200);
  PairFinder finder(starting_at(50, 50));
  const std::vector<Box> first = boxes_of(200, 9.0F, 4);
  const std::vector<Box> second = boxes_of(200, 9.0F, 5);
  ASSERT_TRUE(finder.load(first, flags).ok());
  ASSERT_TRUE(finder.update_on_device(lying(second)).ok());
  EXPECT_TRUE(found_by(finder) == overlapping(second, flags));
  ASSERT_TRUE(finder.update(first).ok());
  EXPECT_TRUE(found_by(finder) == overlapping(first, flags));
}

TEST(DeviceBoxesOnHost, AreRefusedByTheFirstBadBox) {
  const auto flags = some_static(100);
  const float wrong[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity(), 1e6F};
  for (const float value : wrong) {
    std::vector<Box> boxes = boxes_of(100, 9.0F, 6);
    PairFinder finder(starting_at(50, 50));
    ASSERT_TRUE(finder.load_on_device(lying(boxes), flags).ok());
    boxes[61].min.y = value;
    boxes[83].min.x = value;
    const core::Status refused = finder.update_on_device(lying(boxes));
    ASSERT_FALSE(refused.ok()) << value;
    EXPECT_EQ(refused.error().line(), finder.update(boxes).error().line()) << "the line that boxes of the host get";
    EXPECT_EQ(refused.error().where, "box 61");
    boxes = boxes_of(100, 9.0F, 6);
    ASSERT_TRUE(finder.update_on_device(lying(boxes)).ok()) << "it goes on";
    EXPECT_TRUE(found_by(finder) == overlapping(boxes, flags));
  }
}

TEST(DeviceBoxesOnHost, OfAnotherNumberAreRefused) {
  PairFinder finder(starting_at(50, 50));
  const std::vector<Box> boxes = boxes_of(20, 3.0F, 7);
  ASSERT_TRUE(finder.load_on_device(lying(boxes), some_static(20)).ok());
  const std::vector<Box> fewer(boxes.begin(), boxes.begin() + 19);
  EXPECT_EQ(finder.update_on_device(lying(fewer)).error().line(), finder.update(fewer).error().line());
}

TEST(DeviceBoxesOnHost, OfNoBodyGiveNoPair) {
  PairFinder finder(starting_at(50, 50));
  ASSERT_TRUE(finder.load_on_device({}, {}).ok());
  EXPECT_TRUE(found_by(finder).empty());
}

TEST(DeviceBoxesOnHost, AreNotForTheSpatialHash) {
  PairFinder finder({Broad::kHash, core::Variant::kSound, 0.5F, 50});
  const std::vector<Box> boxes = boxes_of(20, 3.0F, 7);
  const core::Status refused = finder.load_on_device(lying(boxes), some_static(20));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().what, "it takes boxes only from the host");
}

TEST(OrderedBits, FollowTheOrderOfFloats) {
  const float rising[] = {-std::numeric_limits<float>::max(), -1.0F, -1e-40F, 0.0F, 1e-40F, 0.5F, 1.0F,
                          std::numeric_limits<float>::max()};
  for (std::size_t k = 0; k < std::size(rising); ++k) {
    EXPECT_EQ(from_ordered_bits(ordered_bits(rising[k])), rising[k]);
    if (k == 0) continue;
    EXPECT_LT(ordered_bits(rising[k - 1]), ordered_bits(rising[k]));
  }
  EXPECT_GT(ordered_bits(-std::numeric_limits<float>::max()), BoxMeasure{}.largest_side);
}

// Passes and cells are chosen as for the same boxes in host memory.
TEST(DeviceBoxesOnHost, HavePassesWhereTheyAreLongAndThin) {
  PairFinderOptions options = starting_at(50, 1U << 30);
  options.least_for_passes = 100;
  PairFinder by_device(options);
  PairFinder by_host(options);
  const std::vector<Box> first = datasets::needle_boxes(700, 2);
  const std::vector<Box> second = datasets::needle_boxes(700, 3);
  const auto flags = some_static(first.size());
  ASSERT_TRUE(by_device.load_on_device(lying(first), flags).ok());
  ASSERT_TRUE(by_host.load(first, flags).ok());
  EXPECT_GT(by_host.plan().passes.size(), 1U);
  EXPECT_EQ(by_device.plan().passes.size(), by_host.plan().passes.size());
  EXPECT_EQ(found_by(by_device), overlapping(first, flags));
  ASSERT_TRUE(by_device.update_on_device(lying(second)).ok());
  EXPECT_EQ(by_device.plan().passes.size(), by_host.plan().passes.size());
  EXPECT_EQ(found_by(by_device), overlapping(second, flags));
  // A new set of boxes is measured anew.
  const std::vector<Box> plain = boxes_of(300, 12.0F, 1);
  ASSERT_TRUE(by_device.load_on_device(lying(plain), some_static(300)).ok());
  EXPECT_TRUE(by_device.plan().is_plain());
  EXPECT_EQ(found_by(by_device), overlapping(plain, some_static(300)));
}

TEST(DeviceBoxesOnHost, HaveFittedCells) {
  std::vector<Box> boxes;
  Dice dice(3);
  for (int k = 0; k < 2500; ++k) {
    const float side = k == 0 ? 1.0F : 0.27F;
    const core::Vec3 low{4.0F * dice.next(), 4.0F * dice.next(), dice.next()};
    boxes.push_back({low, low + core::Vec3{side, side, side}});
  }
  const std::vector<std::uint8_t> flags(boxes.size());
  const auto tests_of = [&](float scale, bool is_on_device) {
    PairFinderOptions options = starting_at(50, 50);
    options.least_for_passes = 1U << 30;
    options.cell_scale = scale;
    PairFinder finder(options);
    finder.count_work();
    EXPECT_TRUE((is_on_device ? finder.load_on_device(lying(boxes), flags) : finder.load(boxes, flags)).ok());
    EXPECT_TRUE(finder.find().ok());
    for (const core::Counter& counter : finder.counters())
      if (std::string_view(counter.name) == "broad: box tests") return counter.count;
    return std::uint64_t{0};
  };
  const std::uint64_t fitted = tests_of(0.0F, true);
  EXPECT_EQ(fitted, tests_of(0.0F, false));
  EXPECT_LT(2 * fitted, tests_of(1.0F, true));
}

}  // namespace
}  // namespace broadside::gpu

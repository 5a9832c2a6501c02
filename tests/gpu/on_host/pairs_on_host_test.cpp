// The GPU's broad phases, with the kernels' threads on the host, return exactly the overlapping pairs.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu/broad/pair_finder.hpp"
#include "gpu/broad/shared_boxes.hpp"
#include "tests/gpu/small_scenes.hpp"
#include "tests/reference/scene_octree/box_family.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Pair;

// The numbers of boxes from which on each search is used; the last two concern a broad phase alone.
PairFinderOptions starting_at(Broad broad, std::uint32_t grid, std::uint32_t many, std::uint32_t bins) {
  return {broad, core::Variant::kSound, 0.5F, grid, many, bins};
}
constexpr std::uint32_t kNever = 1U << 30;
// A tile counts fewer bins than it reaches over.
PairFinderOptions by_coarse_bins() {
  PairFinderOptions options = starting_at(Broad::kTree, 50, 50, 50);
  options.most_bins_at_once = 1;
  return options;
}

PairFinderOptions by_four_lanes() {
  PairFinderOptions options = starting_at(Broad::kTree, 50, 50, kNever);
  options.lanes_per_box = kLanesOfCrowd;
  return options;
}

PairFinderOptions by_groups() {
  PairFinderOptions options = starting_at(Broad::kTree, 50, 50, kNever);
  options.groups = 1;
  return options;
}

void expect_exact(const std::vector<Box>& boxes) {
  std::vector<std::uint8_t> is_static(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) is_static[i] = i % 7 == 0 ? 1 : 0;
  std::vector<Pair> expected;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (core::overlaps(boxes[i], boxes[j]) && (is_static[i] == 0 || is_static[j] == 0)) expected.push_back({i, j});
  const std::pair<const char*, PairFinderOptions> subjects[] = {
      {"grid", starting_at(Broad::kTree, 50, kNever, kNever)},
      {"many", starting_at(Broad::kTree, 50, 50, kNever)},
      {"bins", starting_at(Broad::kTree, 50, 50, 50)},
      {"coarse bins", by_coarse_bins()},
      {"four lanes a box", by_four_lanes()},
      {"groups", by_groups()},
      {"octree", starting_at(Broad::kOctree, 50, 50, 50)},
      {"hash", starting_at(Broad::kHash, 50, 50, 50)},
  };
  for (const auto& [name, options] : subjects) {
    PairFinder subject(options);
    ASSERT_TRUE(subject.load(boxes, is_static).ok());
    for (int turn = 0; turn < 2; ++turn) {  // the second turn uses the tables as the first one left them
      ASSERT_TRUE(subject.find().ok());
      auto found = subject.read_back();
      ASSERT_TRUE(found.ok());
      EXPECT_TRUE(found.value().pairs == expected)
          << name << ": " << found.value().pairs.size() << " against " << expected.size();
    }
  }
}

std::vector<Box> boxes_of(std::uint32_t count, auto make) {
  std::vector<Box> boxes;
  Dice dice(7);
  for (std::uint32_t i = 0; i < count; ++i) {
    const core::Vec3 center = make(dice, i);
    const core::Vec3 half{0.25F + 0.5F * dice.next(), 0.25F + 0.5F * dice.next(), 0.25F + 0.5F * dice.next()};
    boxes.push_back({center - half, center + half});
  }
  return boxes;
}

// Long boxes through a cube, in all directions: groups of neighbors reach everywhere.
std::vector<Box> long_boxes(std::uint32_t count) {
  std::vector<Box> boxes;
  Dice dice(11);
  for (std::uint32_t i = 0; i < count; ++i) {
    const core::Vec3 center = dice.cube(100.0F);
    core::Vec3 half{0.05F, 0.05F, 0.05F};
    half[static_cast<int>(i % 3)] = 40.0F;
    boxes.push_back({center - half, center + half});
  }
  return boxes;
}

struct GroupedSearch {
  std::vector<Pair> pairs;
  std::string path;
};
GroupedSearch search_by_groups(const std::vector<Box>& boxes) {
  PairFinderOptions options = by_groups();
  options.least_for_passes = kNever;
  PairFinder subject(options);
  EXPECT_TRUE(subject.load(boxes, std::vector<std::uint8_t>(boxes.size())).ok());
  EXPECT_TRUE(subject.find().ok());
  auto found = subject.read_back();
  EXPECT_TRUE(found.ok());
  return {found.value().pairs, subject.path()};
}

std::vector<Pair> all_pairs_of(const std::vector<Box>& boxes) {
  std::vector<Pair> expected;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (core::overlaps(boxes[i], boxes[j])) expected.push_back({i, j});
  return expected;
}

// 50 pairs of groups a group: more than there is room for at first.
TEST(PairsOnHost, GroupsGetRoomForTheirPairs) {
  const std::vector<Box> boxes = long_boxes(3200);
  const GroupedSearch found = search_by_groups(boxes);
  EXPECT_TRUE(found.pairs == all_pairs_of(boxes)) << found.pairs.size();
  EXPECT_NE(found.path.find("groups"), std::string::npos) << found.path;
}

// 94 pairs of groups a group: the other search takes over.
TEST(PairsOnHost, GroupsWithTooManyPairsAreGivenUp) {
  const std::vector<Box> boxes = long_boxes(6000);
  const GroupedSearch found = search_by_groups(boxes);
  EXPECT_TRUE(found.pairs == all_pairs_of(boxes)) << found.pairs.size();
  EXPECT_EQ(found.path.find("groups"), std::string::npos) << found.path;
}

// How much work groups are depends on the order of threads within a cell: where work is counted, the other search runs.
TEST(PairsOnHost, NoGroupsWhereWorkIsCounted) {
  PairFinder subject(by_groups());
  const std::vector<Box> boxes = long_boxes(300);
  subject.count_work();
  ASSERT_TRUE(subject.load(boxes, std::vector<std::uint8_t>(boxes.size())).ok());
  ASSERT_TRUE(subject.find().ok());
  EXPECT_EQ(subject.path().find("groups"), std::string::npos) << subject.path();
}

TEST(PairsOnHost, CountsLaunchesAndBytes) {
  const std::vector<Box> boxes = boxes_of(300, [](Dice& dice, std::uint32_t) { return dice.cube(30.0F); });
  const std::vector<std::uint8_t> is_static(boxes.size());
  PairFinder subject({Broad::kTree, core::Variant::kSound, 0.5F, 50});
  ASSERT_TRUE(subject.load(boxes, is_static).ok());
  for (int frame = 0; frame < 3; ++frame) {
    ASSERT_TRUE(subject.update(boxes).ok());
    ASSERT_TRUE(subject.find().ok());
    ASSERT_TRUE(subject.read_back().ok());
  }
  std::map<std::string_view, std::uint64_t> counts;
  for (const core::Counter& counter : subject.counters()) counts[counter.name] = counter.count;
  EXPECT_EQ(counts["launches"], 3U);
  EXPECT_EQ(counts["bytes to the device"], 4U * boxes.size() * sizeof(PackedBox));
  EXPECT_GT(counts["device bytes"], boxes.size() * sizeof(PackedBox));
}

// There are two launches a frame where one of them puts the boxes in order first.
TEST(PairsOnHost, CountsBothLaunches) {
  const std::vector<Box> boxes = boxes_of(300, [](Dice& dice, std::uint32_t) { return dice.cube(30.0F); });
  const std::vector<std::uint8_t> is_static(boxes.size());
  PairFinder subject(starting_at(Broad::kTree, 50, 50, 50));
  ASSERT_TRUE(subject.load(boxes, is_static).ok());
  ASSERT_TRUE(subject.find().ok());
  std::map<std::string_view, std::uint64_t> counts;
  for (const core::Counter& counter : subject.counters()) counts[counter.name] = counter.count;
  EXPECT_EQ(counts["launches"], 2U);
}

TEST(PairsOnHost, Uniform) {
  for (const std::uint32_t count : {0U, 1U, 49U, 400U})
    expect_exact(boxes_of(count, [count](Dice& dice, std::uint32_t) { return dice.cube(std::cbrt(float(count))); }));
}

TEST(PairsOnHost, SizesOverSixOrders) {
  std::vector<Box> boxes;
  Dice dice(3);
  for (std::uint32_t i = 0; i < 300; ++i) {
    const float half = std::pow(10.0F, -4.0F + 4.6F * dice.next());
    const core::Vec3 center = dice.cube(20.0F);
    boxes.push_back({center - core::Vec3{half, 0.5F * half, 0.1F * half}, center + core::Vec3{half, half, half}});
  }
  expect_exact(boxes);
}

TEST(PairsOnHost, FarFromTheOrigin) {
  expect_exact(boxes_of(300, [](Dice& dice, std::uint32_t) {
    return core::Vec3{1e6F, -1e6F, 1e6F} + dice.cube(12.0F);
  }));
}

// Negative and positive cells, and more of them than the table has buckets for.
TEST(PairsOnHost, ClustersInAWideWorld) {
  expect_exact(boxes_of(500, [](Dice& dice, std::uint32_t i) {
    const float side = static_cast<float>(i % 3) - 1.0F;
    return core::Vec3{4000.0F * side, 100.0F * side, -700.0F * side} + dice.cube(i % 50 == 0 ? 900.0F : 9.0F);
  }));
}

// More partners than a lane has room to note at once.
TEST(PairsOnHost, Crowd) {
  expect_exact(boxes_of(200, [](Dice& dice, std::uint32_t) { return dice.cube(1.5F); }));
  expect_exact(std::vector<Box>(100, Box{{1.0F, 2.0F, 3.0F}, {2.0F, 3.0F, 4.0F}}));
}

// Rows of cells are cut into runs, also between two boxes that only touch.
TEST(PairsOnHost, TouchingAlongEachAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Box> boxes;
    for (int i = 0; i < 400; ++i) {
      Box box{{0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F}};
      box.min[axis] = static_cast<float>(i) - 200.0F;
      box.max[axis] = static_cast<float>(i) - 199.0F;
      boxes.push_back(box);
    }
    expect_exact(boxes);
  }
}

// Several tiles, each over more bins than it may count: such a tile is gone through more than once.
TEST(PairsOnHost, TilesOverSeveralCoarseBins) {
  const std::vector<Box> boxes = boxes_of(2600, [](Dice& dice, std::uint32_t) { return dice.cube(14.0F); });
  const std::vector<std::uint8_t> is_static(boxes.size());
  std::vector<std::vector<Pair>> found;
  for (const PairFinderOptions& options : {starting_at(Broad::kTree, 50, 50, kNever), by_coarse_bins()}) {
    PairFinder subject(options);
    ASSERT_TRUE(subject.load(boxes, is_static).ok());
    ASSERT_TRUE(subject.find().ok());
    found.push_back(subject.read_back().value().pairs);
  }
  std::vector<Pair> expected;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (core::overlaps(boxes[i], boxes[j])) expected.push_back({i, j});
  EXPECT_TRUE(found[0] == expected);
  EXPECT_TRUE(found[1] == expected);
}

// A row of cells has more entries than a bin has shared memory for, and strays lie in other bins.
TEST(PairsOnHost, RowThatOverfillsItsBin) {
  std::vector<Box> boxes;
  Dice dice(5);
  for (std::uint32_t i = 0; i < 900; ++i) {
    const core::Vec3 low = i % 10 == 0 ? dice.cube(60.0F) : core::Vec3{60.0F * dice.next(), 0.1F, 0.1F};
    boxes.push_back({low, low + core::Vec3{1.0F, 1.0F, 1.0F}});
  }
  expect_exact(boxes);
}

// Large boxes at one place, and small ones a multiple of 512 blocks of the large ones' cells away. A tag takes both for
// the same block; the small ones are told apart because their own level is wide.
TEST(PairsOnHost, FineBlocksThatLookLikeCoarseOnes) {
  // In a table of 1024 buckets a block has 64 x 4 x 4 cells, of 1 + 1/1024.
  constexpr float kSameX = 512.0F * 64.0F * (1.0F + 0x1p-10F);
  constexpr float kSameY = 512.0F * 4.0F * (1.0F + 0x1p-10F);
  std::vector<Box> boxes;
  Dice dice(5);
  for (std::uint32_t i = 0; i < 480; ++i) {
    const bool is_large = i % 8 == 0;
    const float half = is_large ? 0.5F : 0.1F;
    const core::Vec3 away{i % 16 < 8 ? kSameX : 0.0F, kSameY * static_cast<float>(i / 8 % 8),
                          kSameY * static_cast<float>(i / 64)};
    const core::Vec3 center = dice.cube(2.0F) + (is_large ? core::Vec3{} : away);
    boxes.push_back({center - core::Vec3{half, half, half}, center + core::Vec3{half, half, half}});
  }
  expect_exact(boxes);
}

// Boxes of any finite floats. Boxes near the largest float once sent a search through all cells below theirs, some 2^31
// rows of them, and boxes longer than the largest cell were not found.
TEST(PairsOnHost, EveryFiniteFloat) {
  for (const tests::BoxFamily& family : tests::kBoxFamilies) {
    SCOPED_TRACE(family.name);
    for (const std::uint32_t count : {60U, 110U}) expect_exact(tests::make_case(family, count, 11).boxes);
  }
}

// Boxes far outside of the world for which the cells were made, as of a body that flew away.
TEST(PairsOnHost, BoxesThatHaveLeftTheWorld) {
  std::vector<Box> boxes = boxes_of(120, [](Dice& dice, std::uint32_t) { return dice.cube(5.0F); });
  for (std::size_t k = 0; k < boxes.size(); k += 10) {
    const float far = std::pow(10.0F, 4.0F + static_cast<float>(k) / 4.0F);
    boxes[k] = core::translated(boxes[k], {k % 20 == 0 ? far : -far, far, -far});
  }
  expect_exact(boxes);
}

// Cells that share an entry's tag and its rounded coordinates, hundreds of cells apart, in a table that is smaller than
// the world: only the boxes themselves tell them apart.
TEST(PairsOnHost, CellsThatLookAlike) {
  expect_exact(boxes_of(480, [](Dice& dice, std::uint32_t i) {
    const auto block = [i](std::uint32_t k) { return 512.0F * 1.5F * static_cast<float>((i >> k) & 3U); };
    return core::Vec3{block(0), block(2), block(4)} + dice.cube(2.0F);
  }));
}

}  // namespace
}  // namespace broadside::gpu

// The validators' own overlap set against trying every pair.
#include "validation/overlap_join.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

namespace broadside::tests {
namespace {

using core::Box;
using core::Pair;

std::vector<Pair> every_pair(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& is_static) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
      if (!is_static.empty() && is_static[i] != 0 && is_static[j] != 0) continue;
      bool meet = true;
      for (int k = 0; k < 3; ++k)
        meet = meet && boxes[i].min[k] <= boxes[j].max[k] && boxes[j].min[k] <= boxes[i].max[k];
      if (meet) pairs.push_back({i, j});
    }
  return pairs;
}

std::vector<Box> random_boxes(std::uint32_t count, float extent, float largest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-extent, extent);
  std::uniform_real_distribution<float> side(0.0F, largest);
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < count; ++i) {
    const core::Vec3 low{place(random), place(random), place(random)};
    boxes.push_back({low, {low.x + side(random), low.y + side(random), low.z + side(random)}});
  }
  return boxes;
}

TEST(OverlapJoin, FindsWhatTryingEveryPairFinds) {
  validation::OverlapJoin join;
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<Box> boxes = random_boxes(300 + 37 * seed, 5.0F, 0.1F + 0.1F * static_cast<float>(seed), seed);
    // A few that cover much, a few points, many in one place.
    for (int k = 0; k < 5; ++k) boxes.push_back({{-4.0F, -4.0F, static_cast<float>(k)}, {4.0F, 4.0F, 4.5F}});
    for (int k = 0; k < 20; ++k) boxes.push_back({{1, 1, 1}, {1, 1, 1}});
    std::vector<std::uint8_t> is_static(boxes.size(), 0);
    for (std::size_t k = 0; k < is_static.size(); k += 3) is_static[k] = 1;
    EXPECT_EQ(join.join(boxes, {}), every_pair(boxes, {})) << "seed " << seed;
    EXPECT_EQ(join.join(boxes, is_static), every_pair(boxes, is_static)) << "seed " << seed;
  }
}

// Enough boxes that the join runs on threads.
TEST(OverlapJoin, ManyBoxesOnThreadsGiveWhatTryingEveryPairGives) {
  validation::OverlapJoin join;
  std::vector<Box> boxes = random_boxes(20500, 40.0F, 2.5F, 7);
  std::vector<std::uint8_t> is_static(boxes.size(), 0);
  for (std::size_t k = 0; k < is_static.size(); k += 3) is_static[k] = 1;
  EXPECT_EQ(join.join(boxes, is_static), every_pair(boxes, is_static));
  // The memory of the earlier join is used again.
  boxes.resize(20100);
  is_static.resize(20100);
  EXPECT_EQ(join.join(boxes, is_static), every_pair(boxes, is_static));
}

TEST(OverlapJoin, TouchingCountsAndOneUlpApartDoesNot) {
  validation::OverlapJoin join;
  const Box box{{0, 0, 0}, {1, 1, 1}};
  Box beside{{1, 0, 0}, {2, 1, 1}};
  EXPECT_EQ(join.join(std::vector<Box>{box, beside}, {}).size(), 1u);
  beside.min.x = std::nextafter(1.0F, 2.0F);
  EXPECT_TRUE(join.join(std::vector<Box>{box, beside}, {}).empty());
}

TEST(OverlapJoin, NothingAndOneAndImpossibleBoxes) {
  validation::OverlapJoin join;
  EXPECT_TRUE(join.join({}, {}).empty());
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(join.join(std::vector<Box>{box}, {}).empty());
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const Box nan{{kNaN, 0, 0}, {1, 1, 1}};
  const Box everything{{-kInf, -kInf, -kInf}, {kInf, kInf, kInf}};
  const std::vector<Box> boxes{box, nan, core::empty_box(), everything};
  EXPECT_EQ(join.join(boxes, {}), (std::vector<Pair>{{0, 3}}));
}

}  // namespace
}  // namespace broadside::tests

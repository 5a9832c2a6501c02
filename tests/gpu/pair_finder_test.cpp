// The GPU's broad phase returns exactly the overlapping pairs, whatever the boxes.
#include "gpu/broad/pair_finder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/engine/engine.hpp"
#include "gpu/engines.hpp"
#include "gpu/engines_on_cuda.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Pair;

// By the definition, P(6).
std::vector<Pair> all_pairs(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& is_static) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (core::overlaps(boxes[i], boxes[j]) && (is_static[i] == 0 || is_static[j] == 0)) pairs.push_back({i, j});
  return pairs;
}

// The search for many boxes, without bins and with them, however few boxes there are.
constexpr std::uint32_t kNever = 1U << 30;
PairFinderOptions among_many(std::uint32_t least_for_bins) {
  return {Broad::kTree, core::Variant::kSound, 0.25F, 50, 50, least_for_bins};
}

std::vector<Pair> pairs_of(core::BroadPhase& subject, const std::vector<Box>& boxes,
                           const std::vector<std::uint8_t>& is_static) {
  EXPECT_TRUE(subject.load(boxes, is_static).ok());
  EXPECT_TRUE(subject.find().ok());
  auto found = subject.read_back();
  EXPECT_TRUE(found.ok());
  return found.ok() ? std::move(found.value().pairs) : std::vector<Pair>{};
}

class PairFinderTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = gpu_absent(); !why.empty()) GTEST_SKIP() << "not run: " << why;
  }

  static core::Engine engine(const std::string& broad) {
    const core::EngineRow row = broad == "hash" ? hash_gpu_row() : octree_gpu_row();
    auto settings = broad == "hash" ? core::Settings::parse(row.id, row.settings, {})
                                    : core::Settings::parse(row.id, row.settings, {{"broad", broad}});
    auto made = row.create(settings.value());
    EXPECT_TRUE(made.ok());
    return std::move(made).value();
  }

  static void expect_exact(const std::vector<Box>& boxes) {
    std::vector<std::uint8_t> is_static(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) is_static[i] = i % 7 == 0 ? 1 : 0;
    const std::vector<Pair> expected = all_pairs(boxes, is_static);
    for (const std::string broad : {"tree", "octree", "brute", "hash"}) {
      core::Engine subject = engine(broad);
      EXPECT_TRUE(pairs_of(*subject.broad_phase, boxes, is_static) == expected) << broad;
    }
    for (const std::uint32_t least_for_bins : {kNever, 50U}) {
      PairFinder subject(among_many(least_for_bins));
      EXPECT_TRUE(pairs_of(subject, boxes, is_static) == expected)
          << "many, bins from " << least_for_bins << " boxes on";
    }
  }
};

std::vector<Box> boxes_of(std::uint32_t count, auto make) {
  std::vector<Box> boxes;
  Dice dice(7);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto [center, half] = make(dice, i);
    boxes.push_back({center - half, center + half});
  }
  return boxes;
}

struct Place {
  core::Vec3 center;
  core::Vec3 half;
};

TEST_F(PairFinderTest, Uniform) {
  for (const std::uint32_t count : {0U, 1U, 2U, 100U, 2047U, 2048U, 6000U})
    expect_exact(boxes_of(count, [count](Dice& dice, std::uint32_t) {
      return Place{dice.cube(std::cbrt(static_cast<float>(count))),
                   {0.25F + 0.5F * dice.next(), 0.25F + 0.5F * dice.next(), 0.25F + 0.5F * dice.next()}};
    }));
}

// Enough boxes that each search is at its usual size, and several bins are used; two dense heaps in a wide world.
TEST_F(PairFinderTest, SearchesAgreeOnManyBoxes) {
  const std::vector<Box> boxes = boxes_of(150000, [](Dice& dice, std::uint32_t i) {
    const float half = i % 100 == 0 ? 4.0F * dice.next() : 0.4F;
    const core::Vec3 heap{i % 2 == 0 ? 5000.0F : -3000.0F, 0.0F, 0.0F};
    return Place{(i % 50 == 0 ? dice.cube(20000.0F) : heap + dice.cube(40.0F)), {half, half, half}};
  });
  const std::vector<std::uint8_t> is_static(boxes.size());
  PairFinderOptions grid_options;
  grid_options.least_for_bulk = kNever;
  PairFinder grid(grid_options);
  const std::vector<Pair> expected = pairs_of(grid, boxes, is_static);
  EXPECT_GT(expected.size(), boxes.size());
  for (const std::uint32_t least_for_bins : {kNever, 50U}) {
    PairFinder subject(among_many(least_for_bins));
    EXPECT_TRUE(pairs_of(subject, boxes, is_static) == expected) << "many, bins from " << least_for_bins << " boxes on";
  }
  for (const std::uint32_t most_bins : {1U, 1024U}) {
    PairFinderOptions options = among_many(50);
    options.most_bins_at_once = most_bins;
    PairFinder subject(options);
    EXPECT_TRUE(pairs_of(subject, boxes, is_static) == expected) << "coarse bins, " << most_bins << " at once";
  }
}

TEST_F(PairFinderTest, SizesOverSixOrders) {
  expect_exact(boxes_of(6000, [](Dice& dice, std::uint32_t) {
    const float half = std::pow(10.0F, -4.0F + 5.0F * dice.next());
    return Place{dice.cube(30.0F), {half, 0.5F * half, 0.1F * half}};
  }));
}

TEST_F(PairFinderTest, LatticeOfTouchingFaces) {
  expect_exact(boxes_of(4096, [](Dice&, std::uint32_t i) {
    return Place{{static_cast<float>(i % 16), static_cast<float>(i / 16 % 16), static_cast<float>(i / 256) - 8.0F},
                 {0.5F, 0.5F, 0.5F}};
  }));
}

TEST_F(PairFinderTest, Identical) {
  expect_exact(boxes_of(2100, [](Dice&, std::uint32_t) { return Place{{1, 2, 3}, {0.5F, 0.5F, 0.5F}}; }));
}

TEST_F(PairFinderTest, PointsOnALineAndAPlane) {
  expect_exact(boxes_of(3000, [](Dice&, std::uint32_t i) {
    return Place{{static_cast<float>(i / 2), 0.0F, i % 3 == 0 ? 1.0F : 0.0F}, {0.0F, 0.0F, 0.0F}};
  }));
}

TEST_F(PairFinderTest, FarFromTheOrigin) {
  expect_exact(boxes_of(4000, [](Dice& dice, std::uint32_t) {
    const core::Vec3 near = dice.cube(12.0F);
    return Place{core::Vec3{1e6F, -1e6F, 1e6F} + near, {0.4F, 0.4F, 0.4F}};
  }));
}

TEST_F(PairFinderTest, Denormal) {
  expect_exact(boxes_of(3000, [](Dice& dice, std::uint32_t) {
    return Place{dice.cube(1e-38F), {1e-39F, 1e-39F, 1e-39F}};
  }));
}

TEST_F(PairFinderTest, RefusesWhatIsNoBox) {
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<std::uint8_t> moving(1, 0);
  for (const Box bad : {Box{{0, 0, 0}, {inf, 1, 1}}, Box{{1, 0, 0}, {0, 1, 1}}, Box{{NAN, 0, 0}, {1, 1, 1}}}) {
    core::Engine subject = engine("tree");
    const std::vector<Box> boxes{bad};
    EXPECT_FALSE(subject.broad_phase->load(boxes, moving).ok());
  }
}

}  // namespace
}  // namespace broadside::gpu

// Kept pairs, static boxes apart, chunks and sets spread over devices give the pairs of one plain search, on a real GPU
// and on as many as there are. tests/gpu/on_host/ holds them against all pairs, on the host.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gpu/broad/kept_finder.hpp"
#include "gpu/broad/pair_finder.hpp"
#include "gpu/broad/spread_finder.hpp"
#include "gpu/engines_on_cuda.hpp"
#include "gpu/runtime/device_choice.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Pair;

constexpr std::uint32_t kCount = 200'000;

std::vector<Box> boxes_of(std::uint32_t count) {
  std::vector<Box> boxes;
  Dice dice(3);
  const float spread_m = std::cbrt(static_cast<float>(count));
  for (std::uint32_t i = 0; i < count; ++i) {
    const core::Vec3 center = dice.cube(spread_m);
    const core::Vec3 half{0.25F + 0.5F * dice.next(), 0.25F + 0.5F * dice.next(), 0.25F + 0.5F * dice.next()};
    boxes.push_back({center - half, center + half});
  }
  return boxes;
}

std::vector<Pair> pairs_of(core::BroadPhase& finder) {
  EXPECT_TRUE(finder.find().ok());
  auto found = finder.read_back();
  EXPECT_TRUE(found.ok());
  return found.ok() ? std::move(found.value().pairs) : std::vector<Pair>{};
}

class BroadModesOnGpu : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = gpu_absent(); !why.empty()) GTEST_SKIP() << "not run: " << why;
    plain_options.least_for_apart = 0xFFFFFFFFU;
    for (std::uint32_t k = 0; k < kCount; k += 3) is_static[k] = 1;
  }

  std::vector<Pair> plainly_found() const {
    PairFinder plain(plain_options);
    EXPECT_TRUE(plain.load(boxes, is_static).ok());
    return pairs_of(plain);
  }

  PairFinderOptions plain_options;
  std::vector<Box> boxes = boxes_of(kCount);
  std::vector<std::uint8_t> is_static = std::vector<std::uint8_t>(kCount);
};

TEST_F(BroadModesOnGpu, KeptPairs) {
  KeptFinder kept(plain_options);
  ASSERT_TRUE(kept.load(boxes, is_static).ok());
  for (int frame = 0; frame < 8; ++frame) {
    const auto expected = plainly_found();
    EXPECT_GT(expected.size(), kCount);
    EXPECT_TRUE(pairs_of(kept) == expected) << "frame " << frame;
    // One in eight frames is too much for a fat box.
    const float step_m = frame == 5 ? 0.4F : 0.004F;
    for (std::uint32_t k = 0; k < kCount; ++k)
      boxes[k] = core::translated(boxes[k], {k % 2 == 0 ? step_m : -step_m, k % 5 == 0 ? step_m : 0.0F, 0.0F});
    ASSERT_TRUE(kept.update(boxes).ok());
  }
  EXPECT_EQ(kept.counters()[1].count, 2U) << "frames searched";
}

TEST_F(BroadModesOnGpu, StaticBoxesApart) {
  PairFinder apart({});
  ASSERT_TRUE(apart.load(boxes, is_static).ok());
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_TRUE(apart.path().starts_with("static boxes in a table that is kept"));
    EXPECT_TRUE(pairs_of(apart) == plainly_found()) << "frame " << frame;
    for (std::uint32_t k = 0; k < kCount; ++k)
      if (is_static[k] == 0) boxes[k] = core::translated(boxes[k], {0.5F, -0.25F, 0.75F});
    ASSERT_TRUE(apart.update(boxes).ok());
  }
}

TEST_F(BroadModesOnGpu, Chunks) {
  const auto expected = plainly_found();
  PairFinderOptions options = plain_options;
  options.pairs_at_once = expected.size() / 10;
  PairFinder chunked(options);
  ASSERT_TRUE(chunked.load(boxes, is_static).ok());
  int chunks = 0;
  std::uint64_t count = 0;
  ASSERT_TRUE(chunked
                  .hand_on([&](const core::DevicePairs& pairs) -> core::Status {
                    ++chunks;
                    count += pairs.count;
                    return core::Done{};
                  })
                  .ok());
  EXPECT_GE(chunks, 10);
  EXPECT_EQ(count, expected.size());
  EXPECT_TRUE(pairs_of(chunked) == expected);
}

TEST_F(BroadModesOnGpu, SpreadOverTheDevicesThatThereAre) {
  const auto expected = plainly_found();
  auto devices = device_count();
  ASSERT_TRUE(devices.ok());
  for (const std::uint32_t parts : {1U, 2U, 3U, 8U}) {
    SpreadFinder spread({parts, std::min(parts, static_cast<std::uint32_t>(devices.value()))});
    ASSERT_TRUE(spread.load(boxes, is_static).ok());
    EXPECT_TRUE(pairs_of(spread) == expected) << parts << " parts";
    EXPECT_EQ(spread.pair_count(), expected.size());
  }
}

}  // namespace
}  // namespace broadside::gpu

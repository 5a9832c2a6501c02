// Boxes in GPU memory give the pairs that the same boxes in host memory give. The stages run on the host in
// on_host/device_boxes_on_host_test.cpp; this test has real memory and real streams.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gpu/broad/pair_finder.hpp"
#include "gpu/engines_on_cuda.hpp"
#include "gpu/runtime/device_buffer.hpp"
#include "gpu/runtime/host_side.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

using core::Box;
using core::Pair;

std::vector<Box> boxes_of(std::uint32_t count, std::uint32_t seed) {
  std::vector<Box> boxes;
  Dice dice(seed);
  // One box a cubic meter: some four pairs a box, however many there are.
  const float spread_m = std::cbrt(static_cast<float>(count));
  for (std::uint32_t i = 0; i < count; ++i) {
    const core::Vec3 center = dice.cube(spread_m);
    const core::Vec3 half{0.25F + 0.5F * dice.next(), 0.25F + 0.5F * dice.next(), 0.25F + 0.5F * dice.next()};
    boxes.push_back({center - half, center + half});
  }
  return boxes;
}

// Tiles, the grid, the search in bulk, and bins.
class DeviceBoxesOnGpu : public testing::TestWithParam<std::uint32_t> {
 protected:
  void SetUp() override {
    if (const std::string why = gpu_absent(); !why.empty()) GTEST_SKIP() << why;
  }
};

TEST_P(DeviceBoxesOnGpu, GiveThePairsOfBoxesOfTheHost) {
  const std::uint32_t count = GetParam();
  std::vector<std::uint8_t> flags(count);
  for (std::size_t i = 0; i < count; i += 7) flags[i] = 1;
  PairFinder of_device({});
  PairFinder of_host({});
  DeviceBuffer<Box> there;
  Stream theirs;
  ASSERT_TRUE(theirs.create().ok());
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    const std::vector<Box> boxes = boxes_of(count, seed);
    ASSERT_TRUE(there.upload(boxes, "boxes").ok());
    ASSERT_TRUE(wait_for_device("the boxes").ok());
    const core::DeviceBoxes given{reinterpret_cast<const float*>(there.data()), count, seed != 2, theirs.get()};
    ASSERT_TRUE((seed == 1 ? of_device.load_on_device(given, flags) : of_device.update_on_device(given)).ok());
    ASSERT_TRUE((seed == 1 ? of_host.load(boxes, flags) : of_host.update(boxes)).ok());
    ASSERT_TRUE(of_device.find().ok());
    ASSERT_TRUE(of_host.find().ok());
    auto found = of_device.read_back();
    auto expected = of_host.read_back();
    ASSERT_TRUE(found.ok() && expected.ok());
    EXPECT_TRUE(found.value().pairs == expected.value().pairs) << "seed " << seed;
    EXPECT_GT(found.value().pairs.size(), count / 2);
    auto rows = of_device.pairs_on_device();
    ASSERT_TRUE(rows.ok());
    std::vector<Pair> pairs(rows.value().count);
    ASSERT_TRUE(copy_to_host(pairs.data(), rows.value().data, pairs.size() * sizeof(Pair)).ok());
    std::sort(pairs.begin(), pairs.end());
    EXPECT_TRUE(pairs == expected.value().pairs) << "what lies on the device is what is read back";
  }
}

INSTANTIATE_TEST_SUITE_P(Starts, DeviceBoxesOnGpu, testing::Values(500U, 5000U, 60000U, 1200000U));

}  // namespace
}  // namespace broadside::gpu

// States and pairs as they lie on the device are those that are read back. Here the device is the host.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "gpu/frame/pipeline.hpp"
#include "tests/gpu/small_scenes.hpp"

namespace broadside::gpu {
namespace {

std::vector<core::Vec3> rows_of(const float* first, const core::DeviceStates& states) {
  std::vector<core::Vec3> rows(states.bodies);
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::memcpy(&rows[i], reinterpret_cast<const char*>(first) + i * states.row_bytes, sizeof rows[i]);
  return rows;
}

TEST(DeviceStatesOnHost, AreThoseThatAreReadBack) {
  const core::Scene scene = thrown_spheres(4, 6, 30, 3.0F, 3);
  Pipeline pipeline({});
  ASSERT_TRUE(pipeline.load(scene).ok());
  std::size_t pairs_seen = 0;
  for (int step = 0; step <= 4; ++step) {
    if (step > 0) {
      ASSERT_TRUE(pipeline.step(scene.dt_s).ok());
    }
    auto there = pipeline.states_on_device();
    core::FrameRecord frame;
    ASSERT_TRUE(pipeline.read_back(frame, core::RecordLevel::kFull).ok());
    ASSERT_TRUE(there.ok());
    const core::DeviceStates& states = there.value();
    EXPECT_TRUE(rows_of(states.position, states) == frame.position) << "step " << step;
    EXPECT_TRUE(rows_of(states.velocity, states) == frame.velocity) << "step " << step;
    std::vector<core::Pair> pairs(states.pairs, states.pairs + states.pair_count);
    std::sort(pairs.begin(), pairs.end());
    EXPECT_TRUE(pairs == frame.pairs) << "step " << step;
    pairs_seen += pairs.size();
  }
  EXPECT_GT(pairs_seen, 0U);
}

TEST(DeviceStatesOnHost, OfNoSceneAreRefused) {
  const Pipeline pipeline({});
  EXPECT_FALSE(pipeline.states_on_device().ok());
}

}  // namespace
}  // namespace broadside::gpu

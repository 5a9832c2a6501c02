// Islands that stand still sleep, and wake together: RIGID 8.8.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/reference/octree_cpu/rigid/pipeline_rig.hpp"

namespace broadside::tests {
namespace {

using core::FrameRecord;
using core::Vec3;

// Two piles of three cubes, and a ball that comes down on the first after a second and a half.
PipelineRig piles() {
  PipelineRig rig;
  rig.options.sleeps = true;
  const std::uint32_t cube = rig.box(1, 1, 1);
  for (int pile = 0; pile < 2; ++pile)
    for (int k = 0; k < 3; ++k) rig.add(cube, {5.0F * static_cast<float>(pile), 0.5F + static_cast<float>(k), 0}, 1.0F);
  rig.add(rig.ball(0.25), {0.1F, 3.25F + 0.5F * 9.81F * 1.5F * 1.5F, 0}, 1.0F);
  return rig;
}

bool is_asleep(const FrameRecord& f, std::uint32_t body) {
  return f.velocity[body] == Vec3{} && f.angular_velocity[body] == Vec3{};
}

TEST(Sleep, APileSleepsAsOneAndStandsBitForBit) {
  const auto frames = piles().run(85);
  const auto first = std::find_if(frames.begin(), frames.end(), [](const FrameRecord& f) { return is_asleep(f, 0); });
  ASSERT_NE(first, frames.end());
  EXPECT_GE(first - frames.begin(), 31) << "still for 32 steps at least";
  for (std::uint32_t body = 0; body < 6; ++body) {
    EXPECT_FALSE(is_asleep(*(first - 1), body)) << body;
    for (auto f = first; f != frames.end(); ++f) {
      ASSERT_TRUE(is_asleep(*f, body)) << body;
      ASSERT_EQ(f->position[body], first->position[body]);
      ASSERT_EQ(f->orientation[body], first->orientation[body]);
    }
  }
}

// The contacts of sleeping bodies go on giving their impulses: the floor bears three cubes.
TEST(Sleep, WhoSleepsIsStillBorne) {
  const PipelineRig rig = piles();
  const auto frames = rig.run(85);
  ASSERT_TRUE(is_asleep(frames.back(), 0));
  double borne = 0.0;
  for (const core::ContactPoint& p : frames.back().points)
    if (p.a == 0 && core::is_face(p.b)) borne += static_cast<double>(p.impulse.y);
  const double weight = 3.0 * 9.81 * static_cast<double>(rig.scene.dt_s);
  // A body may be put to rest while it moves at up to a sixteenth of the speed that gravity gives in a step.
  EXPECT_NEAR(borne, weight, weight / 8.0);
}

TEST(Sleep, APileWakesAsOneWhereItIsStruckAndNobodyElseDoes) {
  const auto frames = piles().run(150);
  // The first frame, after the pile fell asleep, in which the top of the struck pile moves.
  std::size_t woken = 80;
  while (woken < frames.size() && is_asleep(frames[woken], 2)) ++woken;
  ASSERT_LT(woken, frames.size()) << "the ball wakes nobody";
  for (std::uint32_t body = 0; body < 3; ++body) {
    EXPECT_TRUE(is_asleep(frames[woken - 1], body)) << body;
    EXPECT_FALSE(is_asleep(frames[woken], body)) << body;
  }
  for (std::uint32_t body = 3; body < 6; ++body)
    for (std::size_t k = 80; k < frames.size(); ++k) ASSERT_TRUE(is_asleep(frames[k], body)) << body << " at " << k;
}

TEST(Sleep, IsOffUnlessAskedFor) {
  PipelineRig rig = piles();
  rig.options.sleeps = false;
  const auto frames = rig.run(85);
  for (std::uint32_t body = 0; body < 6; ++body) EXPECT_FALSE(is_asleep(frames.back(), body)) << body;
  EXPECT_FALSE(reference::RigidPipeline(rig.options).declaration_for(rig.scene).declares("sleep_speed_m_s"));
  rig.options.sleeps = true;
  EXPECT_NEAR(reference::RigidPipeline(rig.options).declaration_for(rig.scene).number("sleep_speed_m_s"),
              9.81 / 60.0 / 16.0, 1e-7);
}

TEST(Sleep, HasTheSameBitsOnAnyNumberOfThreads) {
  PipelineRig rig = piles();
  std::vector<std::uint64_t> digests;
  for (const int threads : {1, 2, 3}) {
    rig.options.threads = threads;
    std::uint64_t sum = 0;
    for (const FrameRecord& f : rig.run(150)) sum = 31 * sum + f.digest;
    digests.push_back(sum);
  }
  EXPECT_EQ(digests[1], digests[0]);
  EXPECT_EQ(digests[2], digests[0]);
}

TEST(Sleep, NobodySleepsWithoutGravity) {
  PipelineRig rig = piles();
  rig.scene.gravity_m_s2 = {};
  const auto frames = rig.run(60);
  EXPECT_FALSE(reference::RigidPipeline(rig.options).declaration_for(rig.scene).declares("sleep_speed_m_s"));
  // Nothing moves here and no body is put to rest, so that a push that comes later acts at once.
  EXPECT_EQ(frames.back().position[0], rig.scene.bodies[0].position);
}

}  // namespace
}  // namespace broadside::tests

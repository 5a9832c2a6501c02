// Fast bodies pass through nothing: RIGID 8.7.
#include "core/method/rigid/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/reference/octree_cpu/rigid/pipeline_rig.hpp"

namespace broadside::tests {
namespace {

using core::FrameRecord;
using core::SweptWay;
using core::Vec3;

core::ContactShape ball(float radius_m) {
  core::ContactShape s;
  s.kind = core::ContactKind::kSphere;
  s.radius_m = s.size_m = radius_m;
  return s;
}

core::ContactShape box(Vec3 half) {
  core::ContactShape s;
  s.kind = core::ContactKind::kBox;
  s.half = half;
  s.size_m = core::length(half);
  return s;
}

SweptWay straight(Vec3 from, Vec3 to) {
  return {{from, {}}, {to, {}}, 0.0F};
}

// Two balls of 0.1 m, 10 m apart, one of which goes 20 m: they touch after 9.8 m.
TEST(Sweep, ABallStopsWhereItTouchesAnother) {
  const float done_m = 0.001F;
  const float share = core::clear_share(ball(0.1F), straight({}, {20, 0, 0}), ball(0.1F),
                                        straight({10, 0, 0}, {10, 0, 0}), 0.0F, done_m);
  EXPECT_LE(share, 0.49F + 1e-6F);
  EXPECT_GE(share, 0.49F - done_m / 20.0F - 1e-6F);
}

TEST(Sweep, ABallThatPassesBesideIsNotStopped) {
  EXPECT_EQ(core::clear_share(ball(0.1F), straight({0, 0.21F, 0}, {20, 0.21F, 0}), ball(0.1F),
                              straight({10, 0, 0}, {10, 0, 0}), 0.0F, 0.001F),
            1.0F);
}

TEST(Sweep, ThinWallsStopWhatIsFasterThanTheyAreThick) {
  const float share = core::clear_share(ball(0.01F), straight({-1, 0, 0}, {4, 0, 0}), box({0.001F, 1, 1}),
                                        straight({}, {}), 0.0F, 1e-5F);
  EXPECT_NEAR(share, (1.0F - 0.01F - 0.001F) / 5.0F, 1e-5F);
}

// A blade of 2 m turns by 90 degrees from along x to along y, and meets a ball at 45 degrees.
TEST(Sweep, ABladeStopsWhereItTurnsIntoABall) {
  const float half = std::sqrt(0.5F);
  SweptWay blade{{{}, {}}, {{}, {half, 0, 0, half}}, 0.0F};
  const float reach_m = core::length(Vec3{1.0F, 0.05F, 0.05F});
  blade.swing_m = core::swing_of(blade.start, blade.end, reach_m);
  const Vec3 at{0.9F * half, 0.9F * half, 0};
  const float share = core::clear_share(box({1.0F, 0.05F, 0.05F}), blade, ball(0.05F), straight(at, at), 0.0F, 1e-3F);
  // The blade's face is 0.05 m from its middle plane, and the ball's surface is 0.05 m before the ball's center: they
  // meet 0.1 / 0.9 rad before 45 degrees. On the chord from one orientation to the other, (1 - s, 0) + s (cos 45, sin
  // 45), that is where the half angle is.
  const double tangent = std::tan(0.5 * (std::atan(1.0) - std::asin(0.1 / 0.9)));
  const double exact = tangent / (std::sqrt(0.5) + tangent * (1.0 - std::sqrt(0.5)));
  EXPECT_LE(share, exact + 1e-6);
  EXPECT_GE(share, exact - 2e-3);  // it stops up to 1e-3 m before, of the 1.4 m that the tip goes
}

TEST(Sweep, WhoIsInAnotherMayLeaveIt) {
  EXPECT_EQ(
      core::clear_share(ball(0.1F), straight({0.15F, 0, 0}, {3, 0, 0}), ball(0.1F), straight({}, {}), 0.01F, 0.001F),
      1.0F);
}

// Two balls overlap by 2 cm where 1 cm is allowed: they may part, or stay where they are.
TEST(Sweep, WhoIsTooDeepInAnotherMayOnlyPart) {
  const auto share_to = [](Vec3 to) {
    return core::clear_share(ball(0.1F), straight({0.18F, 0, 0}, to), ball(0.1F), straight({}, {}), 0.01F, 0.001F);
  };
  EXPECT_EQ(share_to({0.19F, 0, 0}), 1.0F);
  EXPECT_EQ(share_to({0.18F, 0.06F, 0}), 1.0F) << "sideways";
  EXPECT_EQ(share_to({0.17F, 0, 0}), 0.0F);
  EXPECT_EQ(share_to({-0.3F, 0, 0}), 0.0F) << "through it";
}

// Before, bodies went deeper step by step: each step allowed a little more than the one before had left.
TEST(Sweep, WhoIsHeldBetweenOthersComesNoDeeper) {
  float x = 0.195F;  // 5 mm deep where 10 are allowed
  for (int step = 0; step < 100; ++step)
    x += core::clear_share(ball(0.1F), straight({x, 0, 0}, {x - 0.1F, 0, 0}), ball(0.1F), straight({}, {}), 0.01F,
                           0.001F) *
         -0.1F;
  EXPECT_GT(x, 0.2F - (core::kHeldDepth * 0.01F + 2.0F * 0.001F));
  EXPECT_LT(x, 0.19F + 0.001F);
}

// A ball of 1 cm that is fast, and five loose cards of 2 mm that stand one behind the other.
PipelineRig cards(float speed_m_s, bool sweeps) {
  PipelineRig rig;
  rig.options.swept = sweeps ? core::Swept::kAll : core::Swept::kNobody;
  const std::uint32_t bullet = rig.ball(0.01);
  const std::uint32_t card = rig.box(0.002, 0.2, 0.3);
  rig.add(bullet, {-3, 50, 0}, 0.03F, {speed_m_s, 0, 0});
  for (int k = 0; k < 5; ++k) rig.add(card, {0.3F * static_cast<float>(k), 50, 0}, 0.01F);
  return rig;
}

// At this speed the cards stay behind each other. At others they tumble past each other; that is not passing through,
// and the law `passage` tells the two apart.
// which the law `passage` tells apart.
//
// The least distance by which a body is ahead of the one behind it, over all frames: below 0 where one passed through.
float least_lead_m(const std::vector<FrameRecord>& frames) {
  float least = INFINITY;
  for (const FrameRecord& f : frames)
    for (std::size_t i = 1; i < f.position.size(); ++i) least = std::min(least, f.position[i].x - f.position[i - 1].x);
  return least;
}

TEST(Sweep, ABulletPassesThroughNoCardThatItDrivesIntoOthers) {
  EXPECT_GT(least_lead_m(cards(180.0F, true).run(10)), 0.0F);
  EXPECT_LT(least_lead_m(cards(180.0F, false).run(10)), 0.0F) << "nothing to be seen without the sweep";
}

// By default those bodies are swept that the scene flags, against all bodies that they meet.
TEST(Sweep, FollowsWhomTheSceneCallsFast) {
  PipelineRig rig = cards(180.0F, false);
  rig.options.swept = core::Swept::kFlagged;
  const auto sum = [&] {
    std::uint64_t digest = 0;
    for (const FrameRecord& f : rig.run(10)) digest = 31 * digest + f.digest;
    return digest;
  };
  const std::uint64_t with_nobody = sum();
  rig.scene.is_fast.assign(rig.scene.bodies.size(), 0);
  EXPECT_EQ(sum(), with_nobody);
  rig.scene.is_fast.assign(rig.scene.bodies.size(), 1);
  EXPECT_GT(least_lead_m(rig.run(10)), 0.0F);
  const std::uint64_t with_all = sum();
  EXPECT_NE(with_all, with_nobody);
  rig.options.swept = core::Swept::kAll;
  rig.scene.is_fast.clear();
  EXPECT_EQ(sum(), with_all);
  rig.options.swept = core::Swept::kNobody;
  rig.scene.is_fast.assign(rig.scene.bodies.size(), 1);
  EXPECT_EQ(sum(), with_nobody);
}

// The bullet alone is flagged: it passes through no card. Pairs of cards that it drives into each other are not swept.
TEST(Sweep, AFlaggedBulletPassesThroughNoCard) {
  PipelineRig rig = cards(140.0F, false);
  rig.options.swept = core::Swept::kFlagged;
  rig.scene.is_fast.assign(rig.scene.bodies.size(), 0);
  rig.scene.is_fast[0] = 1;
  for (const FrameRecord& f : rig.run(10))
    for (std::size_t i = 1; i < f.position.size(); ++i) ASSERT_GT(f.position[i].x, f.position[0].x) << i;
}

TEST(Sweep, HasTheSameBitsOnAnyNumberOfThreads) {
  PipelineRig rig = cards(300.0F, true);
  std::vector<std::uint64_t> sums;
  for (const int threads : {1, 2, 3}) {
    rig.options.threads = threads;
    std::uint64_t sum = 0;
    for (const FrameRecord& f : rig.run(20)) sum = 31 * sum + f.digest;
    sums.push_back(sum);
  }
  EXPECT_EQ(sums[1], sums[0]);
  EXPECT_EQ(sums[2], sums[0]);
}

// Slow bodies move as they do without the sweep, bit for bit.
TEST(Sweep, ChangesNothingWhereNobodyIsFast) {
  PipelineRig rig;
  const std::uint32_t cube = rig.box(1, 1, 1);
  for (int k = 0; k < 4; ++k)
    rig.add(cube, {0.2F * static_cast<float>(k), 0.5F + 1.2F * static_cast<float>(k), 0}, 1.0F);
  const auto without = rig.run(60);
  rig.options.swept = core::Swept::kAll;
  const auto with = rig.run(60);
  for (std::size_t k = 0; k < with.size(); ++k) ASSERT_EQ(with[k].digest, without[k].digest) << k;
}

// A needle that turns and strikes a plate at 100 m/s spins at ten thousand radians a second about its own axis. Before,
// sweeps over its contacts used the masses of the step's start, and impulses grew without end.
TEST(Sweep, ANeedleThatStrikesAPlateEndsAtNumbers) {
  for (const float spin : {-30.0F, -10.0F, 20.0F, 30.0F}) {
    PipelineRig rig;
    const std::uint32_t needle = rig.box(1.0, 0.01, 0.01);
    rig.add(needle, {-2, 50, 0.03F}, 1.0F, {100, 0, 0}, {0, 0, spin});
    rig.add(rig.box(0.005, 1, 1), {1, 50, 0}, 0.0F);
    for (const FrameRecord& f : rig.run(20))
      for (int k = 0; k < 3; ++k) ASSERT_TRUE(std::isfinite(f.velocity[0][k])) << spin << " at " << f.step;
  }
}

}  // namespace
}  // namespace broadside::tests

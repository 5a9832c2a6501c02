// Expected values: two bodies that stick together after an impact keep their momentum.
#include "core/method/rigid/pushed_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace broadside::core {
namespace {

Pusher body(std::uint32_t index, Vec3 x, Vec3 drift, float inverse_mass = 1.0F) {
  Pusher p;
  p.x = x;
  p.drift = drift;
  p.inverse_mass = inverse_mass;
  p.body = index;
  return p;
}

TEST(PushedMotion, ABodyTakesOverItsShareOfWhatComes) {
  const Pusher still = body(0, {}, {});
  const Pusher comes = body(7, {0, 1, 0}, {0, -0.5F, 0});
  EXPECT_FLOAT_EQ(push_m(push_by(still, comes, 0.0F)), 0.25F);
  EXPECT_FLOAT_EQ(push_m(push_by(still, comes, 1.0F)), 0.5F);
  EXPECT_EQ(pusher_of(push_by(still, comes, 0.0F)), 7U);
  // From a body three times as heavy: v m_b / (m_a + m_b).
  EXPECT_FLOAT_EQ(push_m(push_by(still, body(7, {0, 1, 0}, {0, -0.5F, 0}, 1.0F / 3.0F), 0.0F)), 0.375F);
}

TEST(PushedMotion, WhoLeavesOrFallsAlongPushesNothing) {
  EXPECT_EQ(push_by(body(0, {}, {}), body(1, {0, 1, 0}, {0, 0.5F, 0}), 0.3F), 0U);
  EXPECT_EQ(push_by(body(0, {}, {0, -0.5F, 0}), body(1, {0, 1, 0}, {0, -0.5F, 0}), 0.3F), 0U);
}

TEST(PushedMotion, AStaticBodyIsNotPushed) {
  EXPECT_EQ(push_by(body(0, {}, {}, 0.0F), body(1, {0, 1, 0}, {0, -0.5F, 0}), 0.3F), 0U);
}

// In a row of balls, the second one passes on the push that it is about to receive.
TEST(PushedMotion, APushIsHandedOn) {
  Pusher second = body(1, {1, 0, 0}, {});
  second.pushed = {0.4F, 0, 0};
  second.pusher = 9;
  const PushWord push = push_by(body(2, {2, 0, 0}, {}), second, 0.0F);
  EXPECT_FLOAT_EQ(push_m(push), 0.2F);
  EXPECT_EQ(pusher_of(push), 9U);
}

// A push does not go back to the body that it comes from. That body still notices the other one's approach, more
// weakly.
TEST(PushedMotion, ItsOwnPushDoesNotComeBack) {
  Pusher below = body(1, {0, -1, 0}, {});
  below.pushed = {0, -0.4F, 0};
  below.pusher = 2;
  EXPECT_EQ(push_by(body(2, {}, {0, -0.4F, 0}), below, 0.0F) >> 32,
            push_by(body(2, {}, {0, -0.4F, 0}), body(1, {0, -1, 0}, {}), 0.0F) >> 32);
  EXPECT_EQ(push_by(body(2, {}, {}), below, 0.0F), 0U);
  EXPECT_EQ(pusher_of(push_by(body(3, {}, {}), below, 0.0F)), 2U);
}

// Of two touching bodies the first one is struck. Its expected push is passed on to the second, and replaces the push
// it has where it is stronger.
TEST(PushedMotion, WhatABodyIsToldIsPassedOn) {
  const Pusher first = body(1, {1, 0, 0}, {});
  const PushWord told = push_by(first, body(9, {0, 0, 0}, {0.8F, 0, 0}), 0.0F);
  const Pusher knows = told_of(first, told, {0.8F, 0, 0});
  EXPECT_FLOAT_EQ(knows.pushed.x, 0.4F);
  EXPECT_EQ(knows.pusher, 9U);
  const PushWord push = push_by(body(2, {2, 0, 0}, {}), knows, 0.0F);
  EXPECT_FLOAT_EQ(push_m(push), 0.2F);
  EXPECT_EQ(pusher_of(push), 9U);
  EXPECT_EQ(stronger_push(push, told), told);
  Pusher driven = first;
  driven.pushed = {0.0F, 0.5F, 0.0F};
  driven.pusher = 7;
  EXPECT_EQ(told_of(driven, told, {0.8F, 0, 0}).pusher, 7U);
}

TEST(PushedMotion, TheStrongestPushIsTheLargestWord) {
  const Pusher still = body(0, {}, {});
  const PushWord weak = push_by(still, body(99, {0, 1, 0}, {0, -0.1F, 0}), 0.0F);
  const PushWord strong = push_by(still, body(1, {0, 1, 0}, {0, -0.2F, 0}), 0.0F);
  EXPECT_EQ(std::max(weak, strong), strong);
}

// A body may move along the push by all of it, against the push not at all, and across it by half.
TEST(PushedMotion, ReachesIntoTheBallWhoseDiameterThePushIs) {
  const Vec3 pushed{0, -0.4F, 0};
  EXPECT_FLOAT_EQ(pushed_reach_m(pushed, {0, -1, 0}), 0.4F);
  EXPECT_FLOAT_EQ(pushed_reach_m(pushed, {0, 1, 0}), 0.0F);
  EXPECT_FLOAT_EQ(pushed_reach_m(pushed, {1, 0, 0}), 0.2F);
  const Box grown = pushed_box({{0, 0, 0}, {1, 1, 1}}, pushed);
  EXPECT_FLOAT_EQ(grown.min.y, -0.4F);
  EXPECT_FLOAT_EQ(grown.max.y, 1.0F);
  EXPECT_FLOAT_EQ(grown.min.x, -0.2F);
}

}  // namespace
}  // namespace broadside::core

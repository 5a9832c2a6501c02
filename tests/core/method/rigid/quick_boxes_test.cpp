// Answers about two boxes from one direction, against the exact arbiter on all their ways through the step, and against
// patches.
#include "core/method/rigid/quick_boxes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/method/rigid/passing_by.hpp"
#include "tests/core/method/rigid/manifold_cases.hpp"

namespace broadside::core {
namespace {

struct BoxesNear {
  Subject a;
  Subject b;
  ContactPath path_a;
  ContactPath path_b;
  float reach_m = 0.0F;
};

// Two boxes near each other. Both move by up to half a meter; where they turn, by up to a tenth of a radian.
BoxesNear any_meeting(Draw& draw, bool turns) {
  const auto any_box = [&] {
    return box({draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F), draw.between(0.2F, 1.0F)});
  };
  BoxesNear m{any_box(), any_box(), {}, {}, 0.0F};
  const auto path = [&](Vec3 from) {
    ContactPath way;
    way.start = {from, draw.turn()};
    way.end = {from + draw.in_cube(0.5F), way.start.q};
    if (turns) {
      way.end.q.x += draw.between(-0.05F, 0.05F);
      way.end.q.z += draw.between(-0.05F, 0.05F);
      const float size = std::sqrt(dot(way.end.q, way.end.q));
      way.end.q = (1.0F / size) * way.end.q;
    }
    return way;
  };
  m.path_a = path(draw.in_cube(1.0F));
  m.path_b = path(m.path_a.start.x + 2.0F * normalized(draw.in_cube(1.0F)));
  m.a.pose = m.path_a.start;
  m.b.pose = m.path_b.start;
  m.reach_m = length(m.path_a.end.x - m.path_a.start.x) + length(m.path_b.end.x - m.path_b.start.x);
  return m;
}

// However far each body has come on its own way: the plane separates them where both shares are 0 or 1, so between them
// too.
TEST(QuickBoxes, WhatPassesIsApartOnAllWays) {
  Draw draw(1);
  int passing = 0;
  for (int trial = 0; trial < 600; ++trial) {
    BoxesNear m = any_meeting(draw, false);
    if (!boxes_surely_pass(m.a.shape, m.path_a, m.b.shape, m.path_b, m.reach_m, 0.0F)) continue;
    const exact::SignedDistance start = exact::signed_distance(m.a.placed(), m.b.placed());
    if (start.distance_m > m.reach_m) continue;
    ++passing;
    for (int share_a = 0; share_a <= 4; ++share_a)
      for (int share_b = 0; share_b <= 4; ++share_b) {
        m.a.pose.x = m.path_a.start.x + (0.25F * static_cast<float>(share_a)) * (m.path_a.end.x - m.path_a.start.x);
        m.b.pose.x = m.path_b.start.x + (0.25F * static_cast<float>(share_b)) * (m.path_b.end.x - m.path_b.start.x);
        ASSERT_GT(exact::signed_distance(m.a.placed(), m.b.placed()).distance_m, -rounding_of(m.a, m.b))
            << "trial " << trial << ", shares " << share_a << " and " << share_b;
      }
  }
  EXPECT_GT(passing, 100);
}

// A quick answer agrees with that of patches. The patches of most other pairs are kept only because the bodies are
// near.
TEST(QuickBoxes, OfWhatPassesNoPatchIsKept) {
  Draw draw(2);
  int passing = 0;
  int kept_pairs = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const BoxesNear m = any_meeting(draw, true);
    const float near_m = draw.between(0.0F, 0.2F);
    Manifold found[kPatchesOfPair];
    const int count = make_manifolds(m.a.shape, m.path_a.start, m.b.shape, m.path_b.start, m.reach_m, found);
    int kept = 0;
    for (int k = 0; k < count; ++k)
      kept += passes_by(found[k], m.a.shape, m.path_a, m.b.shape, m.path_b, m.reach_m, near_m) ? 0 : 1;
    kept_pairs += kept;
    if (!boxes_surely_pass(m.a.shape, m.path_a, m.b.shape, m.path_b, m.reach_m, near_m)) continue;
    passing += count;
    EXPECT_EQ(kept, 0) << "trial " << trial;
  }
  EXPECT_GT(passing, 500);
  EXPECT_GT(kept_pairs, 500);
}

// Closed form: cubes of a meter side by side along x; the right one moves.
TEST(QuickBoxes, TheirGapAlongADirectionIsThatOfTheirSides) {
  const Subject cube = box({0.5F, 0.5F, 0.5F});
  const ContactPose left{{3.0F, -2.0F, 7.0F}, {}};
  const ContactPose right{{4.25F, -2.0F, 7.0F}, {}};
  EXPECT_FLOAT_EQ(gap_of_boxes(cube.shape, right, cube.shape, left, {1.0F, 0.0F, 0.0F}), 0.25F);
  EXPECT_FLOAT_EQ(gap_of_boxes(cube.shape, left, cube.shape, right, {-1.0F, 0.0F, 0.0F}), 0.25F);
  EXPECT_FLOAT_EQ(gap_of_boxes(cube.shape, right, cube.shape, left, {0.0F, 1.0F, 0.0F}), -1.0F);
  const ContactPath stays{left, left};
  const auto comes_to = [&](float x) { return ContactPath{right, {{x, -2.0F, 7.0F}, {}}}; };
  EXPECT_TRUE(boxes_surely_pass(cube.shape, comes_to(4.125F), cube.shape, stays, 1.0F, 0.0F));
  EXPECT_FALSE(boxes_surely_pass(cube.shape, comes_to(3.875F), cube.shape, stays, 1.0F, 0.0F));
  EXPECT_FALSE(boxes_surely_pass(cube.shape, comes_to(4.125F), cube.shape, stays, 1.0F, 0.5F)) << "it is near";
}

}  // namespace
}  // namespace broadside::core
